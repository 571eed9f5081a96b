"""A robot of the arena, and how the marker on its roof is mounted.

Frames: `robot` has x forward, y to its left, z up, its origin on the floor below its centre. A
marker whose turn is 0 has its top to the front of the robot.
"""

from dataclasses import dataclass, field

import numpy as np

from tagmetry.errors import InputError
from tagmetry.markers.bodies import MarkerKey


@dataclass(frozen=True)
class Mount:
    """How a marker lies on a robot.

    Attributes:
        height_m: Of the marker above the floor.
        forward_m: Of the marker's centre before the robot's.
        left_m: Of the marker's centre to the left of the robot's.
        turn_rad: By how much the marker's top is turned left of the robot's front.
        height_sd_m: Standard deviation of the height.
    """

    height_m: float
    forward_m: float = 0.0
    left_m: float = 0.0
    turn_rad: float = 0.0
    height_sd_m: float = 0.0

    def __post_init__(self) -> None:
        for name in ("height_m", "forward_m", "left_m", "turn_rad"):
            if not np.isfinite(getattr(self, name)):
                raise InputError(f"{name} must be finite, got {getattr(self, name)}")
        if not 0 <= self.height_sd_m < np.inf:
            raise InputError(f"height_sd_m must not be negative, got {self.height_sd_m}")


@dataclass(frozen=True)
class Robot:
    """A robot that the arena knows.

    Attributes:
        id: Its own number, 0 to 65535.
        name: What people call it.
        diameter_m: Of the circle round its centre that it stays in.
        family: Of the marker on it.
        marker_id: Of the marker on it.
        marker_size_m: Side of the marker's black square.
        mount: How the marker lies on it.
        key: What its packets are signed with; None where it has no link. Never shown.
    """

    id: int
    name: str
    diameter_m: float
    family: str
    marker_id: int
    marker_size_m: float
    mount: Mount
    key: bytes | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        if not 0 <= self.id <= 0xFFFF:
            raise InputError(f"a robot's id is 0 to 65535, got {self.id}")
        for name in ("diameter_m", "marker_size_m"):
            if not 0 < getattr(self, name) < np.inf:
                raise InputError(
                    f"robot {self.id}: {name} must be positive, got {getattr(self, name)}"
                )

    @property
    def marker(self) -> MarkerKey:
        """What tells its marker from others."""
        return MarkerKey(self.family, self.marker_id)

    @property
    def radius_m(self) -> float:
        """Half of its diameter."""
        return self.diameter_m / 2

"""A robot's sensor for its neighbours, as it would have it on board: its reach and its faults.

The options are those of the range-and-bearing sensors of swarm simulators.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError

_NOT_NEGATIVE = (
    "range_sd_m", "range_sd_share", "bearing_sd_rad", "heading_sd_rad", "delay_s", "range_step_m",
    "angle_step_rad",
)  # fmt: skip


@dataclass(frozen=True)
class NeighbourSensor:
    """What a robot would sense of others.

    Attributes:
        range_m: Farthest, from centre to centre.
        view_rad: Width of the field of view; 2 pi is all round.
        view_center_rad: Where its middle looks, from the robot's front, counter-clockwise.
        line_of_sight: Robots and obstacles hide what is behind them.
        range_sd_m: Noise of the range.
        range_sd_share: Noise of the range as a share of it.
        bearing_sd_rad: Noise of the bearing.
        heading_sd_rad: Noise of the relative heading.
        drop_probability: That a neighbour is not told, each time anew.
        delay_s: How old what is told is.
        range_step_m: The range is rounded to multiples of it; 0 is not at all.
        angle_step_rad: The same for the two angles.
        most: At most so many neighbours are told, the nearest; None is all.
    """

    range_m: float = 0.5
    view_rad: float = 2 * np.pi
    view_center_rad: float = 0.0
    line_of_sight: bool = False
    range_sd_m: float = 0.0
    range_sd_share: float = 0.0
    bearing_sd_rad: float = 0.0
    heading_sd_rad: float = 0.0
    drop_probability: float = 0.0
    delay_s: float = 0.0
    range_step_m: float = 0.0
    angle_step_rad: float = 0.0
    most: int | None = None

    def __post_init__(self) -> None:
        if not 0 < self.range_m < np.inf:
            raise InputError(f"range_m must be positive, got {self.range_m}")
        if not 0 < self.view_rad <= 2 * np.pi + 1e-9:
            raise InputError(f"view_rad must be above 0 and at most 2 pi, got {self.view_rad}")
        if not np.isfinite(self.view_center_rad):
            raise InputError(f"view_center_rad must be finite, got {self.view_center_rad}")
        for name in _NOT_NEGATIVE:
            if not 0 <= getattr(self, name) < np.inf:
                raise InputError(f"{name} must not be negative, got {getattr(self, name)}")
        if not 0 <= self.drop_probability <= 1:
            raise InputError(f"drop_probability is 0 to 1, got {self.drop_probability}")
        if self.most is not None and self.most < 0:
            raise InputError(f"most must not be negative, got {self.most}")

    @property
    def is_exact(self) -> bool:
        """Whether chance has no part in what it tells."""
        sds = self.range_sd_m, self.range_sd_share, self.bearing_sd_rad, self.heading_sd_rad
        return not any(sds) and self.drop_probability == 0

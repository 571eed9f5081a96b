"""A path that stands still at every pose and then jumps, as a board held up for a calibration."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform


@dataclass(frozen=True, eq=False)
class Held:
    """It stands at pose i around the time i / rate, and jumps halfway to the next.

    Attributes:
        Ts_world_thing: The poses.
        rate_hz: How many in a second.
    """

    Ts_world_thing: RigidTransform
    rate_hz: float

    def __post_init__(self) -> None:
        if not (np.isfinite(self.rate_hz) and self.rate_hz > 0):
            raise InputError(f"rate_hz must be positive, got {self.rate_hz}")

    @property
    def moves(self) -> bool:
        """Whether there is another pose to jump to."""
        return len(self.Ts_world_thing) > 1

    def at(self, times_s: Array) -> RigidTransform:
        """Return the poses at n times; the first and the last hold on."""
        turn = np.rint(np.asarray(times_s) * self.rate_hz).astype(int)
        return self.Ts_world_thing[np.clip(turn, 0, len(self.Ts_world_thing) - 1)]

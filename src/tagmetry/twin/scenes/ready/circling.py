"""A robot that drives in a circle, its front ahead."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation


@dataclass(frozen=True)
class Circling:
    """It drives round a place on a level floor; its x points ahead.

    Attributes:
        center_m: (x, y, z) of the circle's centre.
        radius_m: Of the circle.
        turn_rad_s: How fast it goes round, against the clock; negative for the other way.
        start_rad: Where on the circle it is at time 0.
    """

    center_m: tuple[float, float, float]
    radius_m: float
    turn_rad_s: float
    start_rad: float

    @property
    def moves(self) -> bool:
        """Whether it goes round at all."""
        return self.turn_rad_s != 0

    def at(self, times_s: Array) -> RigidTransform:
        """Return the poses at n times."""
        angle = self.start_rad + self.turn_rad_s * np.asarray(times_s)
        outward = np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])
        ahead = angle + np.copysign(np.pi / 2, self.turn_rad_s)
        turned = Rotation.from_rotvec(np.outer(ahead, [0.0, 0.0, 1.0]))
        return RigidTransform.from_components(self.center_m + self.radius_m * outward, turned)

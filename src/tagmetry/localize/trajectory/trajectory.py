"""A thing's poses at rising times."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Where something was, and when.

    Attributes:
        times_s: Rising, shape (n,).
        poses: T_world_thing at these times, n of them.
    """

    times_s: Array
    poses: RigidTransform

    def __post_init__(self) -> None:
        if self.poses.single or len(self.poses) != len(self.times_s) or len(self.poses) == 0:
            count = 1 if self.poses.single else len(self.poses)
            raise InputError(
                f"a trajectory has as many poses as times, at least one, in a row; got {count} "
                f"for {len(self.times_s)} times"
            )
        if not np.isfinite(self.times_s).all() or (np.diff(self.times_s) <= 0).any():
            raise InputError("the times of a trajectory must be finite and rise from pose to pose")

    @property
    def positions_m(self) -> Array:
        """Where it was, shape (n, 3)."""
        return np.asarray(self.poses.translation)

    @property
    def length_m(self) -> float:
        """How long its way is."""
        return float(np.linalg.norm(np.diff(self.positions_m, axis=0), axis=1).sum())

    def picked(self, chosen: BoolArray) -> "Trajectory":
        """Return the poses that a mask chooses."""
        return Trajectory(self.times_s[chosen], self.poses[chosen])

    def moved(self, T_other_world: RigidTransform) -> "Trajectory":
        """Return the same way in another world."""
        return Trajectory(self.times_s, T_other_world * self.poses)

    def of_part(self, T_thing_part: RigidTransform) -> "Trajectory":
        """Return the way of something that is fixed to it."""
        return Trajectory(self.times_s, self.poses * T_thing_part)

"""The robots of a world as arrays, and how they lie to each other."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.arena.world_state import WorldState
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import IntArray


@dataclass(frozen=True, eq=False)
class Crowd:
    """The robots of a world as arrays."""

    world: WorldState

    @cached_property
    def rows(self) -> Mapping[int, int]:
        """Of the robots, by id."""
        return {robot.id: row for row, robot in enumerate(self.world.robots)}

    @cached_property
    def ids(self) -> IntArray:
        """Shape (n,)."""
        return np.array([one.id for one in self.world.robots], dtype=np.int64)

    @cached_property
    def ages_s(self) -> Array:
        """Time since the image that each rests on, shape (n,)."""
        return np.array([one.age_s for one in self.world.robots], dtype=np.float64)

    @cached_property
    def places(self) -> Array:
        """(x, y, heading), shape (n, 3)."""
        numbers = [(one.x_m, one.y_m, one.heading_rad) for one in self.world.robots]
        return np.array(numbers, dtype=np.float64).reshape(-1, 3)


def polar(own: Array, places: Array) -> tuple[Array, Array]:
    """Return ranges and bearings of places (n, 2) from (x, y, heading)."""
    x, y = (places - own[:2]).T
    return np.hypot(x, y), wrap_angle_rad(np.arctan2(y, x) - own[2])

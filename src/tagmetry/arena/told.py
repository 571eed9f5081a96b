"""What one robot is told of those around it, in its own frame: x forward, y to its left."""

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import NamedTuple, Self

import numpy as np

from tagmetry.geometry import Array

_NOBODY = np.empty((0, 5))


class Neighbour(NamedTuple):
    """Another robot as a robot senses it; thousands are made of an image, hence a tuple.

    Attributes:
        id: Of the neighbour.
        range_m: From centre to centre.
        bearing_rad: Where it is, from the robot's front, in (-pi, pi].
        relative_heading_rad: Where it heads, from the robot's own heading, in (-pi, pi].
        age_s: Time since the image that this rests on.
    """

    id: int
    range_m: float
    bearing_rad: float
    relative_heading_rad: float
    age_s: float

    @property
    def x_m(self) -> float:
        """Where it is, ahead."""
        return self.range_m * cos(self.bearing_rad)

    @property
    def y_m(self) -> float:
        """Where it is, to the left."""
        return self.range_m * sin(self.bearing_rad)


@dataclass(frozen=True)
class NearObstacle:
    """An obstacle as a robot senses it.

    Attributes:
        name: Of the obstacle.
        range_m: From the robot's centre to its nearest point; 0 inside.
        bearing_rad: Where that point is, from the robot's front, in (-pi, pi].
    """

    name: str
    range_m: float
    bearing_rad: float


@dataclass(frozen=True, eq=False)
class Told:
    """What a robot is told at one moment: the record of it, too.

    Attributes:
        robot_id: Who is told.
        time_s: When.
        sensed: The neighbours, the nearest first, as numbers in the order of `Neighbour`, shape
            (n, 5); they are kept and sent so.
        obstacles: The nearest first.
    """

    robot_id: int
    time_s: float
    sensed: Array
    obstacles: tuple[NearObstacle, ...] = ()

    @classmethod
    def nothing(cls, robot_id: int, time_s: float) -> Self:
        """Return what a robot is told that senses nobody and nothing."""
        return cls(robot_id, time_s, _NOBODY)

    @cached_property
    def neighbours(self) -> tuple[Neighbour, ...]:
        """The nearest first."""
        return tuple(Neighbour(int(one[0]), *one[1:]) for one in self.sensed.tolist())

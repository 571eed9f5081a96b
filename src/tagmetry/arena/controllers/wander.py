"""Wander about: ahead while the way is free, else to the left on the spot until it is.

Always to the left: a robot that turned away from what is nearest would be caught in a corner,
between two things that are nearest by turns.
"""

from dataclasses import dataclass, replace
from math import cos
from typing import Self

from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import Twist

_AHEAD = 0.05  # cosine of the bearing of what the robot would come nearer to


@dataclass(frozen=True)
class Wander:
    """A controller that explores, and turns before robots and obstacles.

    Attributes:
        speed_mps: Ahead.
        turn_radps: On the spot.
        room_m: That has to be free ahead, from rim to rim.
        diameter_m: Of the robots.
    """

    speed_mps: float = 0.15
    turn_radps: float = 1.5
    room_m: float = 0.12
    diameter_m: float = 0.160

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        return Twist(0.0, self.turn_radps) if self._is_blocked(view) else Twist(self.speed_mps, 0.0)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""
        return (
            Parameter("speed_mps", self.speed_mps, 0.02, 0.3, "ahead"),
            Parameter("turn_radps", self.turn_radps, 0.3, 3.0, "on the spot"),
            Parameter("room_m", self.room_m, 0.05, 0.4, "that has to be free ahead"),
        )

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of its parameters changed."""
        return replace(self, **{name: value})

    def _is_blocked(self, view: View) -> bool:
        robots_m = self.room_m + self.diameter_m
        obstacles_m = self.room_m + self.diameter_m / 2
        return any(
            one.range_m < robots_m and cos(one.bearing_rad) > _AHEAD for one in view.neighbours
        ) or any(
            one.range_m < obstacles_m and cos(one.bearing_rad) > _AHEAD for one in view.obstacles
        )

"""What a person can ask of one robot: go to a place, drive a path, stand still."""

from collections.abc import Sequence
from math import atan2, cos, hypot
from typing import Protocol

from tagmetry.arena.controllers import PatientFollower, View, legs_through
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import turned_rad
from tagmetry.live.messages import Task

_ARRIVED_M, _TOP_MPS, _NEARING_PER_S, _TURN_PER_S = 0.02, 0.25, 1.5, 3.0


class Errand(Protocol):
    """A controller that drives until the robot is given back to its own."""

    @property
    def task(self) -> Task:
        """What it is."""

    @property
    def path_m(self) -> tuple[tuple[float, float], ...]:
        """(x, y) of the way points, the goal last; none where it goes nowhere."""

    def __call__(self, view: View) -> Twist:
        """Return how to move."""


class Wait:
    """Stand still."""

    task: Task = "wait"
    path_m: tuple[tuple[float, float], ...] = ()

    def __call__(self, view: View) -> Twist:  # noqa: ARG002 - wherever it is
        """Return that."""
        return STILL


class Visit:
    """Go straight to a place, and stay there."""

    task: Task = "visit"

    def __init__(self, goal_m: tuple[float, float]) -> None:
        """Go to (x, y)."""
        self.path_m = (goal_m,)

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        return toward_goal(view, self.path_m[0])


class Walk:
    """Drive through points, and stay at the last."""

    task: Task = "walk"

    def __init__(self, points_m: Sequence[tuple[float, float]]) -> None:
        """Go through (x, y), from wherever the robot is."""
        self.path_m = tuple(points_m)
        self._follower: PatientFollower | None = None

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        if self._follower is None:
            if view.place is None:
                return STILL
            here_m = view.place.x_m, view.place.y_m
            self._follower = PatientFollower(legs_through((here_m, *self.path_m)))
        return self._follower(view)


def toward_goal(view: View, goal_m: tuple[float, float]) -> Twist:
    """Return the motion that turns a robot to a place (x, y) and brings it there."""
    if view.place is None:
        return STILL
    x_m, y_m = goal_m[0] - view.place.x_m, goal_m[1] - view.place.y_m
    distance_m = hypot(x_m, y_m)
    if distance_m < _ARRIVED_M:
        return STILL
    off_rad = turned_rad(atan2(y_m, x_m) - view.place.heading_rad)
    speed_mps = min(_TOP_MPS, _NEARING_PER_S * distance_m) * max(cos(off_rad), 0.0)
    return Twist(speed_mps, _TURN_PER_S * off_rad)

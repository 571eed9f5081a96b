"""Swarms that gather or spread by neighbours only: no robot knows more than its sensor reaches.

Each rule wishes for a point in the robot's own frame; `driven` is how it goes there.
"""

from dataclasses import dataclass, replace
from typing import Self

import cv2
import numpy as np

from tagmetry.arena.controllers.manner import GENTLE, Manner, driven
from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import Twist

WIDE_CIRCLE = Twist(0.1, 0.3)


@dataclass(frozen=True)
class _Spaced:
    """What robots have that mind a distance.

    Attributes:
        distance_m: Between centres.
        manner: How it moves.
    """

    distance_m: float
    manner: Manner = GENTLE

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""
        wanted = "wanted between two robots' centres"
        return (Parameter("distance_m", self.distance_m, 0.18, 1.0, wanted), self.manner.parameter)

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of its parameters changed."""
        if name == "distance_m":
            return replace(self, distance_m=value)
        return replace(self, manner=self.manner.at_speed(value))


@dataclass(frozen=True)
class Aggregate(_Spaced):
    """Gather: every robot goes to the middle of those it senses, and stops at a distance.

    The middle is that of the smallest circle around them and itself: to go there keeps those
    farthest away in reach, so that a swarm does not come apart as it does where all go to a mean.

    Reference: H. Ando et al., Distributed memoryless point convergence algorithm for mobile robots
    with limited visibility, 1999.

    Attributes:
        distance_m: Between centres where it is near enough.
        manner: How it moves.
        search: What it does while it senses nobody: a wide circle.
    """

    distance_m: float = 0.3
    search: Twist = WIDE_CIRCLE

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        if not view.neighbours:
            return self.search
        x_m, y_m = _middle_of_all(view)
        push_x, push_y = _pushed(view, self.distance_m)
        return driven(x_m + 3 * push_x, y_m + 3 * push_y, self.manner)


@dataclass(frozen=True)
class Disperse(_Spaced):
    """Spread: every robot leaves those that are nearer than a distance.

    Attributes:
        distance_m: Between centres that it wants at least.
        manner: How it moves.
    """

    distance_m: float = 0.5

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        return driven(*_pushed(view, self.distance_m), self.manner)


def _middle_of_all(view: View) -> tuple[float, float]:
    """Return the middle of the smallest circle around a robot and its neighbours, in its frame."""
    points = [(0.0, 0.0), *((one.x_m, one.y_m) for one in view.neighbours)]
    (x_m, y_m), _ = cv2.minEnclosingCircle(np.array(points, dtype=np.float32))
    return x_m, y_m


def _pushed(view: View, distance_m: float) -> tuple[float, float]:
    """Return the sum of pushes away from all that are nearer than a distance."""
    near = [one for one in view.neighbours if one.range_m < distance_m]
    shares = [(distance_m - one.range_m) / max(one.range_m, 1e-3) for one in near]
    push_x = -sum(share * one.x_m for share, one in zip(shares, near, strict=True))
    push_y = -sum(share * one.y_m for share, one in zip(shares, near, strict=True))
    return push_x, push_y

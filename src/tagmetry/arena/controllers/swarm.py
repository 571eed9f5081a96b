"""Groups that form from neighbours only: no robot knows more than its own sensor reaches.

Each rule wishes for a point in the robot's own frame; `driven` is how it goes there.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import atan2, cos, hypot, sin
from typing import Self

import cv2
import numpy as np

from tagmetry.arena.controllers.parameters import Parameter
from tagmetry.arena.controllers.view import View
from tagmetry.arena.drive import STILL, Twist
from tagmetry.arena.place import Place
from tagmetry.arena.told import Neighbour

WIDE_CIRCLE = Twist(0.1, 0.3)


@dataclass(frozen=True)
class Manner:
    """How a robot of a swarm moves.

    Attributes:
        speed_mps: At most.
        turn_per_s: How soon it faces where it goes.
        turn_radps: How fast it turns at most.
        pull_per_s: Wished speed per metre that it is off.
        idle_mps: Slower wishes are not worth a turn.
    """

    speed_mps: float = 0.15
    turn_per_s: float = 4.0
    turn_radps: float = 3.0
    pull_per_s: float = 1.5
    idle_mps: float = 0.005


@dataclass(frozen=True)
class Aggregate:
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
    manner: Manner = Manner()
    search: Twist = WIDE_CIRCLE

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        if not view.neighbours:
            return self.search
        x_m, y_m = _middle_of_all(view)
        push_x, push_y = _pushed(view, self.distance_m)
        return driven(x_m + 3 * push_x, y_m + 3 * push_y, self.manner)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""
        return (_distance(self.distance_m), _speed(self.manner))

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of its parameters changed."""
        if name == "distance_m":
            return replace(self, distance_m=value)
        return replace(self, manner=_at_speed(self.manner, value))


@dataclass(frozen=True)
class Disperse:
    """Spread: every robot leaves those that are nearer than a distance.

    Attributes:
        distance_m: Between centres that it wants at least.
        manner: How it moves.
    """

    distance_m: float = 0.5
    manner: Manner = Manner()

    def __call__(self, view: View) -> Twist:
        """Return how to move."""
        return driven(*_pushed(view, self.distance_m), self.manner)

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""
        return (_distance(self.distance_m), _speed(self.manner))

    def tuned(self, name: str, value: float) -> Self:
        """Return it with one of its parameters changed."""
        if name == "distance_m":
            return replace(self, distance_m=value)
        return replace(self, manner=_at_speed(self.manner, value))


@dataclass(frozen=True)
class Formation:
    """Keep a shape: every robot holds its place beside those of the shape that it senses.

    The shape turns with the robots' common heading: each place is told in the frame of one of them
    and turned by that neighbour's relative heading.

    Attributes:
        places: Of every robot by id, in the shape's own frame.
        leader: Moves by itself; the shape follows it.
        manner: How the others move.
    """

    places: Mapping[int, Place]
    leader: int
    manner: Manner = Manner(speed_mps=0.3)

    def __call__(self, view: View) -> Twist:
        """Return how to move; still where it senses nobody of its shape."""
        own = self.places.get(view.robot)
        known = [one for one in view.neighbours if one.id in self.places]
        if own is None or not known:
            return STILL
        chosen = view.neighbour(self.leader)
        spots = [self._spot(own, one) for one in ([chosen] if chosen else self._before(own, known))]
        x_m = sum(spot.x_m for spot in spots) / len(spots)
        y_m = sum(spot.y_m for spot in spots) / len(spots)
        if hypot(x_m, y_m) < 0.01:  # in its place: turn as the others do
            return Twist(0.0, self.manner.turn_per_s * sin(spots[0].heading_rad))
        return driven(x_m, y_m, self.manner)

    def _before(self, own: Place, known: list[Neighbour]) -> list[Neighbour]:
        """Return those whose places are nearer to the leader's; all where nobody's is.

        Who also heeds those behind waits for them, and a long formation tears.
        """
        lead = self.places[self.leader]
        own_m = own.distance_m(lead) - 1e-6
        return [one for one in known if self.places[one.id].distance_m(lead) < own_m] or known

    def _spot(self, own: Place, neighbour: Neighbour) -> Place:
        """Return the robot's own place of the shape, as a neighbour tells it, in its own frame."""
        there = Place(_x_m(neighbour), _y_m(neighbour), neighbour.relative_heading_rad)
        return there @ own.seen_from(self.places[neighbour.id])

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """What can be changed."""
        return (_speed(self.manner),)

    def tuned(self, name: str, value: float) -> Self:  # noqa: ARG002 - it has one
        """Return it with one of its parameters changed."""
        return replace(self, manner=_at_speed(self.manner, value))


def driven(x_m: float, y_m: float, manner: Manner) -> Twist:
    """Return the motion toward a point of the robot's own frame: it turns, then goes."""
    wish_mps = min(manner.pull_per_s * hypot(x_m, y_m), manner.speed_mps)
    if wish_mps < manner.idle_mps:
        return STILL
    bearing_rad = atan2(y_m, x_m)
    turn_radps = manner.turn_per_s * bearing_rad
    turn_radps = max(-manner.turn_radps, min(turn_radps, manner.turn_radps))
    return Twist(wish_mps * max(cos(bearing_rad), 0.0), turn_radps)


def _distance(distance_m: float) -> Parameter:
    return Parameter("distance_m", distance_m, 0.18, 1.0, "wanted between two robots' centres")


def _speed(manner: Manner) -> Parameter:
    return Parameter("speed_mps", manner.speed_mps, 0.02, 0.3, "at most")


def _at_speed(manner: Manner, speed_mps: float) -> Manner:
    return replace(manner, speed_mps=speed_mps)


def _middle_of_all(view: View) -> tuple[float, float]:
    """Return the middle of the smallest circle around a robot and its neighbours, in its frame."""
    points = [(0.0, 0.0), *((_x_m(one), _y_m(one)) for one in view.neighbours)]
    (x_m, y_m), _ = cv2.minEnclosingCircle(np.array(points, dtype=np.float32))
    return x_m, y_m


def _pushed(view: View, distance_m: float) -> tuple[float, float]:
    """Return the sum of pushes away from all that are nearer than a distance."""
    near = [one for one in view.neighbours if one.range_m < distance_m]
    shares = [(distance_m - one.range_m) / max(one.range_m, 1e-3) for one in near]
    push_x = -sum(share * _x_m(one) for share, one in zip(shares, near, strict=True))
    push_y = -sum(share * _y_m(one) for share, one in zip(shares, near, strict=True))
    return push_x, push_y


def _x_m(one: Neighbour) -> float:
    return one.range_m * cos(one.bearing_rad)


def _y_m(one: Neighbour) -> float:
    return one.range_m * sin(one.bearing_rad)

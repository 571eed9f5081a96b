"""A way through given points: straight lines whose corners are rounded where that can be driven.

A corner that turns by `a` is cut short by c = r tan(a / 2) on both of its sides and replaced by an
arc of radius r. No cut is longer than half of its side, so the radius of a corner between short
sides is smaller. One that is too sharp or too tight is a stop: a leg ends there, and the robot
turns on the spot before the next one begins.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import atan2, hypot, pi, tan

from tagmetry.arena.controllers.course import Arc, Course
from tagmetry.arena.place import Place, turned_rad

_SHARP_RAD = 0.6 * pi
_TIGHT_M = 0.03
_SAME_M = 0.005  # nearer points are one


@dataclass(frozen=True)
class _Side:
    """A straight line between two points."""

    start: Place
    length_m: float


@dataclass(frozen=True)
class _Corner:
    """How one side becomes the next.

    Attributes:
        turn_rad: By how much the way turns.
        cut_m: By how much both sides are shorter for the arc.
        is_stop: The robot stops and turns on the spot.
    """

    turn_rad: float = 0.0
    cut_m: float = 0.0
    is_stop: bool = False

    @property
    def arcs(self) -> tuple[Arc, ...]:
        """The arc; none at a stop, and none where nothing turns."""
        if self.is_stop or self.cut_m == 0:
            return ()
        return (Arc(abs(self.turn_rad) * _radius_m(self.cut_m, self.turn_rad), self.turn_rad),)


def legs_through(
    points_m: Sequence[tuple[float, float]], radius_m: float = 0.12, speed_mps: float = 0.2
) -> tuple[Course, ...]:
    """Return courses to be driven one after another; none where all points are one.

    Args:
        points_m: (x, y) in the world, finite, the first where the robot is.
        radius_m: Of the corners, where there is room.
        speed_mps: To cruise at.
    """
    sides = _sides(points_m)
    if not sides:
        return ()
    corners = [_corner(before, after, radius_m) for before, after in pairwise(sides)]
    return tuple(Course(start, arcs, speed_mps) for start, arcs in _legs(sides, corners))


def _sides(points_m: Sequence[tuple[float, float]]) -> list[_Side]:
    kept: list[tuple[float, float]] = []
    for x_m, y_m in points_m:
        if not kept or hypot(x_m - kept[-1][0], y_m - kept[-1][1]) > _SAME_M:
            kept.append((x_m, y_m))
    return [_side(start, end) for start, end in pairwise(kept)]


def _side(start: tuple[float, float], end: tuple[float, float]) -> _Side:
    x_m, y_m = end[0] - start[0], end[1] - start[1]
    return _Side(Place(*start, atan2(y_m, x_m)), hypot(x_m, y_m))


def _corner(before: _Side, after: _Side, radius_m: float) -> _Corner:
    turn_rad = turned_rad(after.start.heading_rad - before.start.heading_rad)
    room_m = min(before.length_m, after.length_m) / 2
    cut_m = min(radius_m * tan(abs(turn_rad) / 2), room_m)
    if abs(turn_rad) > _SHARP_RAD or (cut_m > 0 and _radius_m(cut_m, turn_rad) < _TIGHT_M):
        return _Corner(turn_rad, is_stop=True)
    return _Corner(turn_rad, cut_m)


def _radius_m(cut_m: float, turn_rad: float) -> float:
    return cut_m / tan(abs(turn_rad) / 2)


def _legs(
    sides: Sequence[_Side], corners: Sequence[_Corner]
) -> Iterator[tuple[Place, tuple[Arc, ...]]]:
    """Yield each leg's start and pieces."""
    start, arcs = sides[0].start, list[Arc]()
    ends = zip([_Corner(), *corners], [*corners, _Corner()], strict=True)
    for side, (before, after) in zip(sides, ends, strict=True):
        start = start if arcs else side.start
        line_m = side.length_m - before.cut_m - after.cut_m
        arcs += [Arc(line_m)] if line_m > 0 else []
        arcs += after.arcs
        if after.is_stop:
            yield start, tuple(arcs)
            arcs = []
    yield start, tuple(arcs)

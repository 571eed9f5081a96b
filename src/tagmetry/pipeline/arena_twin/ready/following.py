"""Robots that follow each other at 20 cm, as if tied by damped springs."""

from functools import partial
from math import pi

import numpy as np

from tagmetry.arena.controllers import Arc, Course, PathFollower, SpringFollower, line_loop_line
from tagmetry.arena.place import Place
from tagmetry.pipeline.arena_twin.ready.stage import robot
from tagmetry.pipeline.arena_twin.scenario import TwinRobot

_GAP_M = 0.20
_PER_TRAIN = 4
_BEGIN_S = 1.0


def leader_follower(robots: int, _rng: np.random.Generator) -> tuple[TwinRobot, ...]:
    """Leaders drive a line, a loop and a line (seed 001, figure 13); the others follow in trains.

    Two robots are the seed's experiment; more are trains of four that drive round after round.
    """
    if robots <= 2:
        path = line_loop_line(Place(-0.8, 0.0, 0.0))
        course = Course(path.start, path.arcs, start_s=_BEGIN_S)
        return _train(0, robots, course)
    sizes = [len(part) for part in np.array_split(np.arange(robots), -(-robots // _PER_TRAIN))]
    first = np.concatenate([[0], np.cumsum(sizes)[:-1]]).tolist()
    trains = (
        _train(n, size, loop, loop.arcs[-1].turn_rad / loop.arcs[-1].length_m)
        for n, size, loop in zip(first, sizes, _loops(len(sizes)), strict=True)
    )
    return tuple(one for train in trains for one in train)


def _train(first: int, size: int, course: Course, bend_per_m: float = 0.0) -> tuple[TwinRobot, ...]:
    """Return a leader on its course, and the rest behind it along a bend that leads there."""
    leader = TwinRobot(robot(first), course.start, partial(PathFollower, course))
    behind = (
        TwinRobot(
            robot(first + n),
            course.start.moved(-n * _GAP_M, -n * _GAP_M * bend_per_m),
            partial(SpringFollower, first + n - 1),
        )
        for n in range(1, size)
    )
    return (leader, *behind)


def _loops(count: int) -> list[Course]:
    """Return side by side stadiums, driven for an hour."""
    columns = min(count, 4)
    rows = -(-count // columns)
    width_m, height_m = 3.2 / columns, 1.7 / rows
    radius_m = min(0.35, height_m / 2 - 0.12, width_m / 2 - 0.12)
    radius_m = max(radius_m, 0.12)
    side_m = max(width_m - 2 * radius_m - 0.25, 0.05)
    courses = []
    for n in range(count):
        x_m = (n % columns + 0.5) * width_m - 1.6 - side_m / 2
        y_m = (n // columns + 0.5) * height_m - 0.85 - radius_m
        lap = (Arc(side_m), Arc(pi * radius_m, pi)) * 2
        start = Place(x_m, y_m, 0.0)
        courses.append(Course(start, lap * 200, speed_mps=0.15, start_s=_BEGIN_S))
    return courses

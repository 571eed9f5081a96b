"""Swarms: robots that know nothing but their neighbours."""

from functools import partial

import numpy as np

from tagmetry.arena.controllers import (
    Aggregate,
    Arc,
    Controller,
    Course,
    Disperse,
    Formation,
    PathFollower,
    Shielded,
    ShieldRules,
)
from tagmetry.arena.place import Place
from tagmetry.arena.safety import Fence
from tagmetry.pipeline.arena_twin.ready.stage import FLOOR_HALF_M, RIM_M, robot, scattered
from tagmetry.pipeline.arena_twin.scenario import TwinRobot

SPREAD_M = 0.45  # between robots that disperse
_CROWD_STEP_M, _BLOCK_STEP_M = 0.22, 0.28
_WAY_M, _SPEED_MPS = 1.8, 0.08  # of a formation's leader
_Half = tuple[float, float]


def aggregate(
    robots: int, rng: np.random.Generator, half_m: _Half = FLOOR_HALF_M
) -> tuple[TwinRobot, ...]:
    """Robots all over the floor gather."""
    make = partial(_shielded, Aggregate(), half_m)
    places = scattered(robots, rng, half_m=half_m)
    return tuple(TwinRobot(robot(n), place, make) for n, place in enumerate(places))


def disperse(
    robots: int, rng: np.random.Generator, half_m: _Half = FLOOR_HALF_M
) -> tuple[TwinRobot, ...]:
    """Robots in a crowd, of the floor's own shape, spread until each has room."""
    columns = int(np.ceil(np.sqrt(robots * half_m[0] / half_m[1])))
    rows = int(np.ceil(robots / columns))
    number = np.arange(robots)
    middle = np.array([columns - 1, rows - 1]) / 2
    xy_m = _CROWD_STEP_M * (np.column_stack([number % columns, number // columns]) - middle)
    turns = rng.uniform(-np.pi, np.pi, robots).tolist()
    make = partial(_shielded, Disperse(SPREAD_M), half_m)
    return tuple(
        TwinRobot(robot(n), Place(x_m, y_m, turn), make)
        for n, ((x_m, y_m), turn) in enumerate(zip(xy_m.tolist(), turns, strict=True))
    )


def formation(
    robots: int, rng: np.random.Generator, half_m: _Half = FLOOR_HALF_M
) -> tuple[TwinRobot, ...]:
    """Robots gather behind a leader as a block, and keep it while the leader drives on."""
    shape = block(robots)
    behind_m = -min(place.x_m for place in shape.values())
    begin_m = max(-_WAY_M / 2, behind_m + RIM_M - half_m[0])
    way_m = min(_WAY_M, half_m[0] - RIM_M - begin_m)
    course = Course(Place(begin_m, 0.0, 0.0), (Arc(way_m),), speed_mps=_SPEED_MPS, start_s=8.0)
    leader = TwinRobot(robot(0), course.start, partial(PathFollower, course))
    keep = partial(_shielded, Formation(shape, leader=0), half_m)
    others = (
        TwinRobot(robot(n), _disturbed(course.start @ shape[n], rng), keep)
        for n in range(1, robots)
    )
    return (leader, *others)


def block(robots: int) -> dict[int, Place]:
    """Return a block's places by id, as robot 0 before its middle sees them."""
    columns = max(3, int(np.ceil(np.sqrt(robots - 1))))
    shape = {0: Place(0.0, 0.0, 0.0)}
    for n in range(1, robots):
        row, column = divmod(n - 1, columns)
        aside = column - (columns - 1) / 2
        shape[n] = Place(-_BLOCK_STEP_M * (row + 1), _BLOCK_STEP_M * aside, 0.0)
    return shape


def _shielded(controller: Controller, half_m: _Half) -> Controller:
    x_m, y_m = half_m
    fence = Fence(((-x_m, -y_m), (x_m, -y_m), (x_m, y_m), (-x_m, y_m)))
    return Shielded(controller, ShieldRules(fence=fence))


def _disturbed(place: Place, rng: np.random.Generator) -> Place:
    x_m, y_m = (place.xy_m + rng.uniform(-0.04, 0.04, 2)).tolist()
    return Place(x_m, y_m, rng.uniform(-np.pi, np.pi))

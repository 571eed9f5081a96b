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
from tagmetry.pipeline.arena_twin.ready.stage import FLOOR_HALF_M, robot, scattered
from tagmetry.pipeline.arena_twin.scenario import TwinRobot

_X_M, _Y_M = FLOOR_HALF_M
FENCE = Fence(((-_X_M, -_Y_M), (_X_M, -_Y_M), (_X_M, _Y_M), (-_X_M, _Y_M)))


def aggregate(robots: int, rng: np.random.Generator) -> tuple[TwinRobot, ...]:
    """Robots all over the floor gather."""
    return tuple(
        TwinRobot(robot(n), place, partial(_shielded, Aggregate()))
        for n, place in enumerate(scattered(robots, rng))
    )


def disperse(robots: int, rng: np.random.Generator) -> tuple[TwinRobot, ...]:
    """Robots in a crowd spread until each has room."""
    columns = int(np.ceil(np.sqrt(robots)))
    places = [
        Place(0.22 * (n % columns - columns / 2), 0.22 * (n // columns - columns / 2), turn)
        for n, turn in enumerate(rng.uniform(-np.pi, np.pi, robots).tolist())
    ]
    return tuple(
        TwinRobot(robot(n), place, partial(_shielded, Disperse(0.45)))
        for n, place in enumerate(places)
    )


def formation(robots: int, rng: np.random.Generator) -> tuple[TwinRobot, ...]:
    """Robots gather behind a leader as a block, and keep it while the leader drives on."""
    shape = {n: _in_block(n) for n in range(robots)}
    course = Course(Place(-0.9, 0.0, 0.0), (Arc(1.8),), speed_mps=0.08, start_s=8.0)
    leader = TwinRobot(robot(0), course.start, partial(PathFollower, course))
    others = (
        TwinRobot(robot(n), _disturbed(course.start @ shape[n], rng), _keeper(shape))
        for n in range(1, robots)
    )
    return (leader, *others)


def _keeper(shape: dict[int, Place]) -> partial[Controller]:
    return partial(_shielded, Formation(shape, leader=0))


def _shielded(controller: Controller) -> Controller:
    return Shielded(controller, ShieldRules(fence=FENCE))


def _in_block(number: int) -> Place:
    """Return a place of a block in rows of three behind robot 0."""
    row, column = divmod(number + 2, 3)
    return Place(-0.28 * row, 0.28 * (column - 1), 0.0) if number else Place(0.0, 0.0, 0.0)


def _disturbed(place: Place, rng: np.random.Generator) -> Place:
    x_m, y_m = (place.xy_m + rng.uniform(-0.04, 0.04, 2)).tolist()
    return Place(x_m, y_m, rng.uniform(-np.pi, np.pi))

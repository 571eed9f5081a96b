"""Scenarios that are ready to run, by name."""

from collections.abc import Callable
from functools import partial

import numpy as np

from tagmetry.arena import Obstacle
from tagmetry.arena.controllers import Controller
from tagmetry.errors import InputError
from tagmetry.pipeline.arena_twin.ready import stage
from tagmetry.pipeline.arena_twin.ready.following import leader_follower
from tagmetry.pipeline.arena_twin.ready.swarms import aggregate, disperse, formation
from tagmetry.pipeline.arena_twin.ready.wandering import OBSTACLES, wander
from tagmetry.pipeline.arena_twin.scenario import Scenario, TwinRobot

READY: dict[str, Callable[[int, np.random.Generator], tuple[TwinRobot, ...]]] = {
    "leader_follower": leader_follower,
    "aggregate": aggregate,
    "disperse": disperse,
    "formation": formation,
    "wander": wander,
}
_OBSTACLES: dict[str, tuple[Obstacle, ...]] = {"wander": OBSTACLES}


def ready_scenario(name: str, robots: int, seed: int = 0) -> Scenario:
    """Return a scenario by its name.

    Args:
        name: One of `READY`.
        robots: How many.
        seed: Of the robots' starts and of all noise.
    """
    if name not in READY:
        raise InputError(f"there is no scenario {name!r}; there are {', '.join(READY)}")
    _check_count(robots)
    twins = READY[name](robots, np.random.default_rng(seed))
    obstacles = _OBSTACLES.get(name, ())
    return Scenario(twins, stage.view(), obstacles=obstacles, seed=seed)


def driven_scenario(make: Callable[[int], Controller], robots: int, seed: int = 0) -> Scenario:
    """Return robots all over the floor, each with a controller made from its id."""
    _check_count(robots)
    places = stage.scattered(robots, np.random.default_rng(seed))
    twins = tuple(
        TwinRobot(stage.robot(n), place, partial(make, n)) for n, place in enumerate(places)
    )
    return Scenario(twins, stage.view(), seed=seed)


def _check_count(robots: int) -> None:
    if not 1 <= robots <= stage.MOST_ROBOTS:
        raise InputError(f"expected 1 to {stage.MOST_ROBOTS} robots, got {robots}")

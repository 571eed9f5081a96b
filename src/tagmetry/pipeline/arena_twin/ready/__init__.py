"""Scenarios that are ready to run, by name."""

from collections.abc import Callable

import numpy as np

from tagmetry.errors import InputError
from tagmetry.pipeline.arena_twin.ready import stage
from tagmetry.pipeline.arena_twin.ready.following import leader_follower
from tagmetry.pipeline.arena_twin.ready.swarms import aggregate, disperse, formation
from tagmetry.pipeline.arena_twin.scenario import Scenario, TwinRobot

READY: dict[str, Callable[[int, np.random.Generator], tuple[TwinRobot, ...]]] = {
    "leader_follower": leader_follower,
    "aggregate": aggregate,
    "disperse": disperse,
    "formation": formation,
}


def ready_scenario(name: str, robots: int, seed: int = 0) -> Scenario:
    """Return a scenario by its name.

    Args:
        name: One of `READY`.
        robots: How many.
        seed: Of the robots' starts and of all noise.
    """
    if name not in READY:
        raise InputError(f"there is no scenario {name!r}; there are {', '.join(READY)}")
    if not 1 <= robots <= stage.MOST_ROBOTS:
        raise InputError(f"expected 1 to {stage.MOST_ROBOTS} robots, got {robots}")
    twins = READY[name](robots, np.random.default_rng(seed))
    return Scenario(twins, stage.view(), seed=seed)

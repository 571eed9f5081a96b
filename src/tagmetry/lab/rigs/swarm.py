"""Swarms under a ceiling camera: on the ready-made stage, or in a hall twice as large for many."""

from collections.abc import Iterator, Mapping
from contextlib import closing
from math import inf, nan
from time import process_time

import numpy as np

from tagmetry.arena.place import Place
from tagmetry.geometry import Array
from tagmetry.lab.rows import SwarmPlace
from tagmetry.pipeline.arena_twin import Moment, Scenario, TwinArena
from tagmetry.pipeline.arena_twin.ready import stage
from tagmetry.pipeline.arena_twin.ready.swarms import aggregate, block, disperse, formation

TASKS = {"aggregate": aggregate, "disperse": disperse, "formation": formation}
_MOST_ON_THE_STAGE = 36


def swarm_scenario(task: str, robots: int, seed: int) -> Scenario:
    """Return a swarm before it moves.

    Args:
        task: One of `TASKS`.
        robots: More than 36 are given a hall of twice the size, its camera twice as high.
        seed: Of starts and noise.
    """
    scale = 1 if robots <= _MOST_ON_THE_STAGE else 2
    half_m = (scale * stage.FLOOR_HALF_M[0], scale * stage.FLOOR_HALF_M[1])
    twins = TASKS[task](robots, np.random.default_rng(seed), half_m)
    return Scenario(twins, stage.view(scale * stage.HEIGHT_M), seed=seed)


def swarmed(
    task: str, robots: int, repeat: int, duration_s: float, seed: int
) -> Iterator[SwarmPlace]:
    """Yield where every robot is, about once a second."""
    touched: set[int] = set()
    spent_s, begun_s, next_s = 0.0, process_time(), 0.0
    with closing(TwinArena(swarm_scenario(task, robots, seed))) as arena:
        for moment in arena.run(duration_s):
            touched |= {one for pair in moment.touching for one in pair}
            if moment.time_s < next_s:
                continue
            next_s += 1.0
            spent_s += process_time() - begun_s
            yield from _rows(task, repeat, moment, touched, spent_s)
            begun_s = process_time()


def _rows(
    task: str, repeat: int, moment: Moment, touched: set[int], spent_s: float
) -> Iterator[SwarmPlace]:
    nearest_m = _nearest_m(np.array([place.xy_m for place in moment.places.values()]))
    told = {one.robot_id: len(one.neighbours) for one in moment.turn.told}
    off_m = _off_m(moment.places) if task == "formation" else {}
    for row, (robot, place) in enumerate(moment.places.items()):
        yield SwarmPlace(
            task,
            len(moment.places),
            repeat,
            moment.time_s,
            robot,
            place.x_m,
            place.y_m,
            float(nearest_m[row]),
            off_m.get(robot, nan),
            told.get(robot, 0),
            robot in touched,
            spent_s,
        )


def _nearest_m(xy_m: Array) -> Array:
    apart_m = np.linalg.norm(xy_m[:, None] - xy_m[None], axis=-1)
    np.fill_diagonal(apart_m, inf)
    return np.asarray(apart_m.min(axis=1))


def _off_m(places: Mapping[int, Place]) -> dict[int, float]:
    """Return how far each robot is from its place in the block, by id; the leader is robot 0."""
    shape = block(len(places))
    return {one: (places[0] @ shape[one]).distance_m(place) for one, place in places.items()}

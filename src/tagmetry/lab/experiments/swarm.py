"""Swarms that know nothing but their neighbours: 24 and 100 robots gather, spread, keep a shape.

They go through the whole twin: physics, camera, arena, controllers and packets. Seed 001 builds its
set-up for swarms and prints no figure of one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from tagmetry.lab.beside.swarm import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.swarm import TASKS, swarmed
from tagmetry.lab.rows import SwarmPlace

_DURATIONS_S = {"aggregate": 15.0, "disperse": 15.0, "formation": 40.0}  # its leader drives


@dataclass(frozen=True)
class Case:
    """One run.

    Attributes:
        task: What the swarm does.
        robots: How many.
        duration_s: Of simulated time.
        repeat: Which.
    """

    task: str
    robots: int
    duration_s: float
    repeat: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return tasks and numbers of robots."""
    if quick:
        return tuple(Case(task, 6, 12.0, 0) for task in TASKS)
    runs = ((24, 0), (24, 1), (100, 0))
    return tuple(
        Case(task, robots, _DURATIONS_S[task], repeat) for robots, repeat in runs for task in TASKS
    )


def measure(case: Case, seed: int) -> Sequence[SwarmPlace]:
    """Return where every robot is, once a second."""
    return list(swarmed(case.task, case.robots, case.repeat, case.duration_s, seed))


EXPERIMENT = Experiment(
    name="swarm",
    title="How soon does a swarm gather, spread and keep a shape, and does anybody touch?",
    source="seed 001, sections 1 and 4: up to 24 robots; no figure of a swarm is printed",
    row=SwarmPlace,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

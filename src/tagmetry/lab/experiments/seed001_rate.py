"""Seed 001, figure 10: images per second against the number of robots, for the whole pipeline.

Images come from memory. What is counted is the processor time of an image, of all threads:
detection, places, tracks, neighbours and decisions for ours, detectMarkers and solvePnP for the
paper's steps.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena import Arena, Neighbourhood, NeighbourSensor, OverheadView, Roster
from tagmetry.camera import Image
from tagmetry.detect import Detector, Tracker
from tagmetry.lab.beside.seed001_rate import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.crowd import crowd, film, there_and_back
from tagmetry.lab.rigs.overhead import CAMERA, FAMILY, T_WORLD_CAMERA
from tagmetry.lab.rigs.overhead_paper import seen_places
from tagmetry.lab.rows import Rate
from tagmetry.pipeline.arena import ArenaMeasurement, Turning

_LENGTH = 6  # of the film, which is played there and back
_WARM = 10  # images that are not counted


@dataclass(frozen=True)
class Case:
    """So many robots.

    Attributes:
        robots: How many.
        images: How many images ours gets; the paper's steps get a fifth of them.
    """

    robots: int
    images: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return numbers of robots up to the paper's last, and beyond."""
    counts = (1, 24) if quick else (1, 6, 13, 24, 50, 100)
    return tuple(Case(count, 60 if quick else 120) for count in counts)


def measure(case: Case, seed: int) -> Sequence[Rate]:
    """Return what an image costs by both methods."""
    rng = np.random.default_rng(seed)
    images = film(case.robots, _LENGTH, rng)
    task = _pipeline(case.robots)
    played = there_and_back(images, _WARM + case.images)
    few = there_and_back(images, 2 + case.images // 5)
    size_m = task.turning.arena.roster.robots[0].marker_size_m
    return [
        _rate("tagmetry", case, played, _WARM, lambda one: len(task.measure(one).step.seen)),
        _rate("paper", case, few, 2, lambda one: len(seen_places(one.pixels, CAMERA, size_m))),
    ]


def _pipeline(count: int) -> ArenaMeasurement:
    view = OverheadView(CAMERA, T_WORLD_CAMERA, np.zeros((6, 6)))
    arena = Arena(Roster(crowd(count)), view)
    turning = Turning(arena, Neighbourhood(NeighbourSensor(0.3)))
    detector = Detector([FAMILY])
    return ArenaMeasurement(turning, CAMERA, detector, Tracker(detector))


def _rate(
    method: str, case: Case, images: Sequence[Image], warm: int, found_in: Callable[[Image], int]
) -> Rate:
    counts, costs_ms = [], []
    for image in images:
        begin_s = time.process_time()
        counts.append(found_in(image))
        costs_ms.append(1000 * (time.process_time() - begin_s))
    middle_ms, tail_ms = np.quantile(costs_ms[warm:], [0.5, 0.9]).tolist()
    return Rate(method, case.robots, float(np.mean(counts[warm:])), middle_ms, tail_ms)


EXPERIMENT = Experiment(
    name="seed001-rate",
    title="How many images per second, with how many robots?",
    source="seed 001, figure 10",
    row=Rate,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

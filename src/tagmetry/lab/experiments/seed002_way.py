"""Seed 002's markers, seen by a camera that moves: every method, and the filter over time.

The camera wanders from rest at 2 to 6 m, ten images a second. At the end no image is taken for two
seconds, and then one.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

from tagmetry.lab.beside.seed002_way import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.marker_floor import LayoutName, Stand
from tagmetry.lab.rigs.wandering import followed, followed_methods
from tagmetry.lab.rows import Followed

_LAYOUTS: tuple[LayoutName, ...] = get_args(LayoutName)


@dataclass(frozen=True)
class Case:
    """Some ways from one place.

    Attributes:
        layout: Which markers there are.
        distance_m: From the camera to their middle where it begins.
        images: How many before the loss.
        repeats: How many ways.
        methods: By which every image is localized.
    """

    layout: LayoutName
    distance_m: float
    images: int
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every layout from some distances."""
    distances_m = (2.0, 5.0) if quick else (2.0, 3.0, 4.0, 5.0, 6.0)
    return tuple(
        Case(layout, distance_m, 20, 1 if quick else 4, followed_methods())
        for layout in _LAYOUTS
        for distance_m in distances_m
    )


def measure(case: Case, seed: int) -> Sequence[Followed]:
    """Return how far every method is off in every image."""
    stand = Stand(case.layout, case.distance_m)
    return [
        row
        for repeat in range(case.repeats)
        for row in followed(stand, case.images, repeat, seed + 1000 * repeat)
    ]


EXPERIMENT = Experiment(
    name="seed002-way",
    title="How far off is a moving camera's place, image by image and followed over time?",
    source="seed 002's markers; no published figure",
    row=Followed,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

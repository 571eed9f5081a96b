"""Seed 002, figures 7 to 12: one marker that leans, in pitch or in roll, from 1 to 7 m."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.lab.beside.seed002_tilt import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.localized import localized_repeatedly, method_names
from tagmetry.lab.rigs.marker_floor import LookName, Stand
from tagmetry.lab.rows import Localization


@dataclass(frozen=True)
class Case:
    """All pictures of one stand.

    Attributes:
        axis: About which the marker leans: pitch is about y, roll about x.
        look: What the pictures are like.
        distance_m: From the camera to the marker.
        lean_deg: How far it leans.
        repeats: How many pictures.
        methods: By which each is localized.
    """

    axis: Literal["pitch", "roll"]
    look: LookName
    distance_m: float
    lean_deg: float
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every lean at every distance, both ways, as a simulator and as a webcam sees it."""
    distances_m = np.linspace(1, 7, 7 if quick else 13).tolist()
    leans_deg = np.arange(-60, 61, 30 if quick else 15).tolist()
    axes: tuple[Literal["pitch", "roll"], ...] = ("pitch", "roll")
    looks: tuple[LookName, ...] = ("simulator", "webcam")
    return tuple(
        Case(axis, look, distance_m, lean_deg, 2 if quick else 5, method_names())
        for axis in axes
        for look in looks
        for distance_m in distances_m
        for lean_deg in leans_deg
    )


def measure(case: Case, seed: int) -> Sequence[Localization]:
    """Return how far every method is off in every picture."""
    pitch_deg, roll_deg = (case.lean_deg, 0.0) if case.axis == "pitch" else (0.0, case.lean_deg)
    stand = Stand("one", case.distance_m, 0.0, pitch_deg, roll_deg, case.look)
    return list(localized_repeatedly(stand, case.repeats, seed))


EXPERIMENT = Experiment(
    name="seed002-tilt",
    title="How far off is a camera's place when its one marker leans?",
    source="seed 002, figures 7 to 12",
    row=Localization,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

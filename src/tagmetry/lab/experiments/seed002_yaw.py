"""Seed 002, figures 4 to 6 and 14 to 25: distance, yaw, and how many markers.

The camera looks down on 1, 2, 4, 4 inclined, or 4 inclined and 1 perpendicular markers from 1 to
7 m, and turns about its axis. One marker is seen with a webcam's noise too, for the paper's real
setting.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import get_args

import numpy as np

from tagmetry.lab.beside.seed002_yaw import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.localized import localized_repeatedly, method_names
from tagmetry.lab.rigs.marker_floor import LayoutName, LookName, Stand
from tagmetry.lab.rows import Localization

LAYOUTS: tuple[LayoutName, ...] = get_args(LayoutName)


@dataclass(frozen=True)
class Case:
    """All pictures of one stand.

    Attributes:
        layout: Which markers there are.
        look: What the pictures are like.
        distance_m: From the camera to their middle.
        yaw_deg: Of the camera.
        repeats: How many pictures.
        methods: By which each is localized.
    """

    layout: LayoutName
    look: LookName
    distance_m: float
    yaw_deg: float
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every layout at every distance and yaw."""
    distances_m = np.linspace(1, 7, 7 if quick else 13).tolist()
    yaws_deg = np.arange(-180, 180, 90 if quick else 45).tolist()
    seen: list[tuple[LayoutName, LookName]] = [(layout, "simulator") for layout in LAYOUTS]
    return tuple(
        Case(layout, look, distance_m, yaw_deg, 2 if quick else 5, method_names())
        for layout, look in [*seen, ("one", "webcam")]
        for distance_m in distances_m
        for yaw_deg in yaws_deg
    )


def measure(case: Case, seed: int) -> Sequence[Localization]:
    """Return how far every method is off in every picture."""
    stand = Stand(case.layout, case.distance_m, case.yaw_deg, look=case.look)
    return list(localized_repeatedly(stand, case.repeats, seed))


EXPERIMENT = Experiment(
    name="seed002-yaw",
    title="How far off is a camera's place, by distance, yaw and number of markers?",
    source="seed 002, figures 4 to 6 and 13 to 25",
    row=Localization,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

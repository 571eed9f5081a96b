"""Seed 004, figures 7 and 10: a robot before a wall with one or two markers, from 20 to 150 cm.

One marker of 10 cm is seen with the webcam and with both settings of the other camera (figure 7),
one and two of 6 cm with the wide setting (figure 10),
the only one that shows both from 20 cm.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.lab.beside.seed004_distance import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.robot_cameras import CameraName
from tagmetry.lab.rigs.robot_localized import robot_localized, robot_methods
from tagmetry.lab.rigs.robot_room import RobotStand
from tagmetry.lab.rows import RobotPlace

_LARGE_M, _SMALL_M = 0.10, 0.06


@dataclass(frozen=True)
class Case:
    """All pictures from one distance.

    Attributes:
        camera: Which camera.
        layout: One marker or two.
        size_m: Their side.
        distance_m: From the robot to the wall.
        repeats: How many pictures.
        methods: By which each is localized.
    """

    camera: CameraName
    layout: Literal["one", "two"]
    size_m: float
    distance_m: float
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every camera and number of markers at every distance."""
    cm = (20, 60, 100, 110, 130, 150) if quick else np.arange(20, 151, 10).tolist()
    settings: list[tuple[CameraName, Literal["one", "two"], float]] = [
        ("webcam", "one", _LARGE_M),
        ("HDR, normal", "one", _LARGE_M),
        ("HDR, wide", "one", _LARGE_M),
        ("HDR, wide", "one", _SMALL_M),
        ("HDR, wide", "two", _SMALL_M),
    ]
    return tuple(
        Case(camera, layout, size_m, one / 100, 4 if quick else 10, robot_methods())
        for camera, layout, size_m in settings
        for one in cm
    )


def measure(case: Case, seed: int) -> Sequence[RobotPlace]:
    """Return how far every method is off in every picture."""
    stand = RobotStand(case.layout, case.size_m, case.distance_m)
    return list(robot_localized(case.camera, stand, case.repeats, seed))


EXPERIMENT = Experiment(
    name="seed004-distance",
    title="How far off is a robot's place, by distance, camera and number of markers?",
    source="seed 004, figures 7 and 10",
    row=RobotPlace,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

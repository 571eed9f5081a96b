"""Seed 004, figures 11 to 13: three places in the corner of a room, and the first once more."""

from collections.abc import Sequence
from dataclasses import dataclass

from tagmetry.lab.beside.seed004_repeat import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.robot_cameras import CameraName
from tagmetry.lab.rigs.robot_localized import robot_localized, robot_methods
from tagmetry.lab.rigs.robot_room import PLACES, RobotStand
from tagmetry.lab.rows import RobotPlace

_SIZES_M = (0.16, 0.10)


@dataclass(frozen=True)
class Case:
    """All pictures of one round through the four places.

    Attributes:
        camera: Which camera.
        size_m: The markers' side.
        repeats: How many rounds.
        methods: By which each picture is localized.
    """

    camera: CameraName
    size_m: float
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return both sizes."""
    repeats = 5 if quick else 20
    return tuple(Case("HDR, normal", size_m, repeats, robot_methods()) for size_m in _SIZES_M)


def measure(case: Case, seed: int) -> Sequence[RobotPlace]:
    """Return how far every method is off at every place."""
    return [
        row
        for place in range(len(PLACES))
        for row in robot_localized(
            case.camera, RobotStand("corner", case.size_m, place=place), case.repeats, seed + place
        )
    ]


EXPERIMENT = Experiment(
    name="seed004-repeat",
    title="Does a robot that comes back find itself where it was?",
    source="seed 004, figures 11 to 13",
    row=RobotPlace,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

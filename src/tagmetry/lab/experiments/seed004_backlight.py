"""Seed 004, figure 8: a marker of 10 cm on a pillar between windows, 1 m before the robot."""

from collections.abc import Sequence
from dataclasses import dataclass

from tagmetry.lab.beside.seed004_backlight import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.robot_cameras import CameraName
from tagmetry.lab.rigs.robot_localized import robot_localized, robot_methods
from tagmetry.lab.rigs.robot_room import RobotStand
from tagmetry.lab.rows import RobotPlace

_WINDOWS = (1.0, 3.0, 10.0, 30.0, 50.0, 100.0)


@dataclass(frozen=True)
class Case:
    """All pictures against one light.

    Attributes:
        camera: Which camera.
        window: How many times brighter than paper the windows are.
        repeats: How many pictures.
        methods: By which each is localized.
    """

    camera: CameraName
    window: float
    repeats: int
    methods: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every brightness of the windows, for a usual response and for one that bends."""
    cameras: tuple[CameraName, ...] = ("webcam", "HDR, normal")
    return tuple(
        Case(camera, window, 4 if quick else 20, robot_methods())
        for camera in cameras
        for window in (_WINDOWS[::2] + _WINDOWS[-1:] if quick else _WINDOWS)
    )


def measure(case: Case, seed: int) -> Sequence[RobotPlace]:
    """Return how far every method is off in every picture."""
    stand = RobotStand("one", 0.10, 1.0, window=case.window)
    return list(robot_localized(case.camera, stand, case.repeats, seed))


EXPERIMENT = Experiment(
    name="seed004-backlight",
    title="Is a robot localized by a marker between bright windows?",
    source="seed 004, figure 8",
    row=RobotPlace,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

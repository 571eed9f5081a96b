"""Calibrations at every so many steps of the focus, one after the other, each kept at once."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.view import BoardView
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.camera import (
    BankNode,
    Camera,
    CameraBank,
    ControlledSource,
    Image,
    VerifiedControls,
)
from tagmetry.camera.controls import Control
from tagmetry.errors import InputError
from tagmetry.lens import Lag, LensSetting
from tagmetry.pipeline.lens.drive import Drive
from tagmetry.sources.controls import by_hand

Views = Callable[[Iterator[Image]], Sequence[BoardView]]
"""Takes images until there are views enough, as a guided calibration does."""


@dataclass(frozen=True, eq=False)
class Calibrated:
    """One more calibration.

    Attributes:
        bank: With it.
        focus: At which focus it was made.
        left: How many are still to be made.
    """

    bank: CameraBank
    focus: float
    left: int


def missing_foci(bank: CameraBank | None, control: Control, step: float) -> tuple[float, ...]:
    """Return the focus values, nearest end first, at which no calibration is there yet.

    Args:
        bank: What is there.
        control: The camera's focus.
        step: From one to the next; the paper has 5, which makes 31.

    Raises:
        InputError: The step is not positive.
    """
    if not 0 < step < float("inf"):
        raise InputError(f"the step of the focus must be positive, got {step}")
    count = int((control.most - control.least) / step + 1e-9) + 1
    wanted = [control.nearest(control.most - step * n) for n in range(count)]
    there = [] if bank is None else [node.focus for node in bank.nodes]
    return tuple(one for one in wanted if all(abs(one - focus) > 1e-6 for focus in there))


def calibrate_bank(
    source: ControlledSource,
    views_of: Views,
    bank: CameraBank | None = None,
    *,
    step: float = 5.0,
    name: str = "camera",
    lag: Lag | None = None,
) -> Iterator[Calibrated]:
    """Give the bank after each calibration that was missing; begin again where it was left.

    Args:
        source: The camera; its zoom stays at its least.
        views_of: Takes the views of the board at one focus.
        bank: What is there already.
        step: From one focus value to the next.
        name: Of the camera.
        lag: How late its controls are.
    """
    with by_hand(VerifiedControls(source.controls)):
        drive = Drive(source, lag)
        zoom = drive.controls.available["zoom"].least
        todo = missing_foci(bank, drive.controls.available["focus"], step)
        for number, focus in enumerate(todo):
            drive.go(LensSetting(zoom, focus))
            camera = calibrate(views_of(_settled(drive))).camera
            node = BankNode(_named(camera, focus, bank.name if bank else name))
            nodes = (*(bank.nodes if bank else ()), node)
            bank = CameraBank(nodes, zoom_is_digital=True)
            yield Calibrated(bank, focus, len(todo) - number - 1)


def _named(camera: Camera, focus: float, name: str) -> Camera:
    return replace(camera, focus=float(np.round(focus, 6)), zoom=1.0, name=name)


def _settled(drive: Drive) -> Iterator[Image]:
    """Give images from the first on that shows the focus."""
    while True:
        taken = drive.take()
        if taken.is_settled:
            yield taken.image

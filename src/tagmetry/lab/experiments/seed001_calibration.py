"""Seed 001, section 3.2: the ceiling camera calibrated with a ChArUco board.

The camera that the paper prints is the true one, with its centre in the middle. It is calibrated
from the same pictures by tagmetry and by OpenCV's ChArUco board, as the paper does.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.lab.beside.seed001_calibration import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.camera_numbers import camera_numbers, projection_rms_px
from tagmetry.lab.rigs.overhead import CAMERA, board_pictures
from tagmetry.lab.rigs.overhead_calibration import METHODS, calibrated
from tagmetry.lab.rows import Quantity


@dataclass(frozen=True)
class Case:
    """The pictures of one calibration.

    Attributes:
        repeat: Which one, each with other noise and other places of the board.
        views: How many pictures.
    """

    repeat: int
    views: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return the repeats."""
    return tuple(Case(repeat, 15 if quick else 24) for repeat in range(1 if quick else 4))


def measure(case: Case, seed: int) -> Sequence[Quantity]:
    """Return the camera's numbers as each method has them, with the truth."""
    pictures = board_pictures(case.views, np.random.default_rng(seed))
    rows: list[Quantity] = []
    for method in METHODS:
        camera, rms_px = calibrated(method, pictures)
        rows += [Quantity(method, case.repeat, *one) for one in camera_numbers(camera, CAMERA)]
        rows.append(Quantity(method, case.repeat, "rms px", rms_px, np.nan, np.nan))
        off_px = projection_rms_px(camera, CAMERA, places=(49, 28))
        rows.append(Quantity(method, case.repeat, "projection rms px", off_px, 0.0, np.nan))
    return rows


EXPERIMENT = Experiment(
    name="seed001-calibration",
    title="Is the ceiling camera found again from pictures of a ChArUco board?",
    source="seed 001, section 3.2, equation 8",
    row=Quantity,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

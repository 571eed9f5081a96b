"""Seed 001, section 3.2: the ceiling camera calibrated with a ChArUco board.

The camera that the paper prints is the true one, with its centre in the middle. It is calibrated
from the same pictures by tagmetry and by OpenCV's ChArUco board, as the paper does.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.lab.beside.seed001_calibration import PARAMETERS, conclude
from tagmetry.lab.experiment import Experiment
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
        rows += [Quantity(method, case.repeat, *one) for one in _numbers(camera)]
        rows.append(Quantity(method, case.repeat, "rms px", rms_px, np.nan, np.nan))
        off_px = _projection_rms_px(camera)
        rows.append(Quantity(method, case.repeat, "projection rms px", off_px, 0.0, np.nan))
    return rows


def _numbers(camera: Camera) -> Iterator[tuple[str, float, float, float]]:
    covariance = camera.covariance
    sd = np.sqrt(np.diag(covariance)) if covariance is not None else np.full(9, np.nan)
    yield from zip(PARAMETERS, _values(camera), _values(CAMERA), sd.tolist(), strict=True)


def _values(camera: Camera) -> list[float]:
    return [*camera.focal_px, *camera.center_px, *camera.lens.coefficients]


def _projection_rms_px(camera: Camera) -> float:
    """Return how far projections are from the true ones, over all of the picture."""
    u, v = np.meshgrid(np.linspace(0, 1919, 49), np.linspace(0, 1079, 28))
    rays = CAMERA.unproject(np.stack([u, v], axis=-1))
    error = camera.project(rays) - CAMERA.project(rays)
    return float(np.sqrt(np.nanmean((error**2).sum(axis=-1))))


EXPERIMENT = Experiment(
    name="seed001-calibration",
    title="Is the ceiling camera found again from pictures of a ChArUco board?",
    source="seed 001, section 3.2, equation 8",
    row=Quantity,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

"""Two halves of the views, each solved by itself: do they lead to the same camera?

The halves share no noise, so that their difference over the image shows the true uncertainty,
lens model and all, without any formula. A turn of the camera between them is no difference.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.quality.projection import image_grid, projection_uncertainty
from tagmetry.calibrate.quality.solved import Solved
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.solve import solve
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray
from tagmetry.geometry.transforms import Rotation

_LEAST_VIEWS = 6
_HALVES_TO_ALL = 2.0  # a half has twice the variance, a difference of two halves four times


@dataclass(frozen=True, eq=False)
class SplitHalves:
    """How two cameras of the same lens differ over the image.

    Attributes:
        cameras: Of the first, third, ... view and of the second, fourth, ...
        pixels: The grid, shape (rows, columns, 2).
        difference_px: Where the second shows what the first shows at these pixels, minus them,
            shape (rows, columns, 2); NaN where one of them shows nothing.
        expected_px: Root mean square length that the covariance of all views together predicts,
            shape (rows, columns).
    """

    cameras: tuple[Camera, Camera]
    pixels: Array
    difference_px: Array
    expected_px: Array

    @property
    def length_px(self) -> Array:
        """Lengths of the differences, shape (rows, columns)."""
        return np.asarray(np.linalg.norm(self.difference_px, axis=-1))

    @property
    def mean_px(self) -> float:
        """Over the image."""
        return float(np.nanmean(self.length_px))

    @property
    def worst_px(self) -> float:
        """The largest over the image."""
        return float(np.nanmax(self.length_px))


def split_halves(calibration: Calibration, columns: int = 20, rows: int = 15) -> SplitHalves:
    """Return how the cameras of two halves of the views differ.

    Args:
        calibration: What was solved from all views.
        columns: Of the grid.
        rows: Of the grid.

    Raises:
        InputError: Fewer than six views, or a half that determines no camera.
    """
    count = len(calibration.views)
    if count < _LEAST_VIEWS:
        raise InputError(f"expected at least {_LEAST_VIEWS} views to split, got {count}")
    solved = Solved.of(calibration)
    order = np.arange(count)
    first, second = _camera(solved, order[::2]), _camera(solved, order[1::2])
    pixels = image_grid(calibration.camera, columns, rows)
    corners_px = solved.seen.corners_px[solved.seen.used]
    difference_px = camera_difference_px(first, second, pixels, corners_px)
    predicted = projection_uncertainty(calibration, columns, rows)
    of_all_px = np.sqrt(np.trace(predicted.covariance_px2, axis1=-2, axis2=-1))
    return SplitHalves((first, second), pixels, difference_px, _HALVES_TO_ALL * of_all_px)


def camera_difference_px(first: Camera, second: Camera, pixels: Array, fit_px: Array) -> Array:
    """Return where the second camera shows what the first shows, minus there.

    Args:
        first: A camera.
        second: Another solution for the same camera.
        pixels: Shape (..., 2).
        fit_px: Where they should agree, shape (n, 2): the second is turned so that they do best.

    Returns:
        Shape (..., 2); NaN where one of them shows nothing.
    """
    of_first, of_second = first.unproject(fit_px), second.unproject(fit_px)
    shown = np.isfinite(of_first).all(axis=1) & np.isfinite(of_second).all(axis=1)
    if shown.sum() < 3:
        return np.full_like(pixels, np.nan)
    turn, _ = Rotation.align_vectors(of_second[shown], of_first[shown])
    rays = first.unproject(pixels)
    return second.project(rays @ turn.as_matrix().T) - pixels


def _camera(solved: Solved, views: IntArray) -> Camera:
    """Return the camera of some of the views."""
    seen = solved.seen.only(views)
    solution = solve(solved.bundle.only(views), seen, solved.freedom)
    if not np.isfinite(solution.cost):
        raise InputError(
            "half of the views do not determine the camera; add views, tilted to several sides"
        )
    return solution.bundle.camera(seen.size_px)

"""What a camera leaves unexplained: mean errors over the image, the board and the radius.

The errors of a good calibration have no pattern: the mean of n of them is as small as noise is,
s / sqrt(n). Where means are larger, the lens model (over the image), the board's print (over the
board) or the finding of corners is at fault.
"""

from dataclasses import dataclass

import numpy as np
from scipy import stats

from tagmetry.calibrate.result import Calibration
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray

_LEAST_CORNERS = 3  # in a bin, for its mean to be judged


@dataclass(frozen=True, eq=False)
class MeanErrors:
    """Mean errors of bins.

    Attributes:
        places: Where the bins are: pixels of centres (b, 2), points on the board (b, 3) in metres,
            or radii (b, 1) in pixels from the principal point.
        mean_px: Mean error, seen minus predicted, shape (b, 2); along the radius and across it for
            bins of radius; NaN for empty bins.
        count: How many corners, shape (b,).
        p_value: Probability that noise alone gives means as large as all of these together; small:
            there is a pattern.
    """

    places: Array
    mean_px: Array
    count: IntArray
    p_value: float

    @property
    def rms_px(self) -> float:
        """Root of the mean squared length of the means, over bins that are not empty."""
        return float(np.sqrt(np.nanmean((self.mean_px**2).sum(axis=1))))

    @property
    def is_pattern(self) -> bool:
        """Whether noise is an unlikely reason, at 0.1 %."""
        return self.p_value < 1e-3


@dataclass(frozen=True, eq=False)
class ResidualField:
    """The errors' means.

    Attributes:
        over_image: In cells of the image, rows from the top.
        over_board: Of each point of the board that was seen.
        over_radius: In rings around the principal point.
        noise_px: Standard deviation of an error along an axis.
    """

    over_image: MeanErrors
    over_board: MeanErrors
    over_radius: MeanErrors
    noise_px: float


def residual_field(calibration: Calibration, columns: int = 10, rows: int = 8) -> ResidualField:
    """Return what a calibration's errors have in common.

    Args:
        calibration: Only corners that were kept count.
        columns: Cells of the image in a row, and rings.
        rows: Rows of cells.

    Raises:
        InputError: No cells.
    """
    if columns < 1 or rows < 1:
        raise InputError(f"expected at least one cell, got {columns}x{rows}")
    error, pixels, points = _kept(calibration)
    noise_px = float(np.sqrt((error**2).sum() / max(2 * len(error) - _unknowns(calibration), 1)))
    return ResidualField(
        _over_image(calibration, error, pixels, (columns, rows), noise_px),
        _over_board(calibration, error, points, noise_px),
        _over_radius(calibration, error, pixels, columns, noise_px),
        noise_px,
    )


def _kept(calibration: Calibration) -> tuple[Array, Array, IntArray]:
    """Return errors (n, 2), pixels (n, 2) and numbers of points (n,) of the corners kept."""
    each = list(zip(calibration.residuals_px, calibration.views, calibration.kept, strict=True))
    return (
        np.concatenate([error[kept] for error, _, kept in each]),
        np.concatenate([view.corners_px[kept] for _, view, kept in each]),
        np.concatenate([view.points[kept] for _, view, kept in each]),
    )


def _unknowns(calibration: Calibration) -> int:
    return calibration.camera.parameter_count + 6 * len(calibration.views)


def _over_image(
    calibration: Calibration, error: Array, pixels: Array, cells: tuple[int, int], noise_px: float
) -> MeanErrors:
    columns, rows = cells
    size = np.array(calibration.camera.size_px)
    column, row = np.clip((pixels + 0.5) // (size / cells), 0, np.array(cells) - 1).astype(int).T
    across, down = np.meshgrid(np.arange(columns), np.arange(rows))
    centres = (np.stack([across.ravel(), down.ravel()], axis=1) + 0.5) * (size / cells) - 0.5
    return _means(centres, row * columns + column, error, noise_px)


def _over_board(
    calibration: Calibration, error: Array, points: IntArray, noise_px: float
) -> MeanErrors:
    seen, of_seen = np.unique(points, return_inverse=True)
    return _means(calibration.p_board[seen], of_seen, error, noise_px)


def _over_radius(
    calibration: Calibration, error: Array, pixels: Array, rings: int, noise_px: float
) -> MeanErrors:
    arm = pixels - calibration.camera.center_px
    radius = np.linalg.norm(arm, axis=1)
    width, height = calibration.camera.size_px
    step = np.hypot(width, height) / 2 / rings
    ring = np.minimum(radius / step, rings - 1).astype(int)
    out = arm / np.maximum(radius, 1e-9)[:, None]
    along = (out * error).sum(axis=1)
    around = out[:, 0] * error[:, 1] - out[:, 1] * error[:, 0]
    middles = (np.arange(rings)[:, None] + 0.5) * step
    return _means(middles, ring, np.stack([along, around], axis=1), noise_px)


def _means(places: Array, of_bin: IntArray, error: Array, noise_px: float) -> MeanErrors:
    """Return the means of bins, judged by chi^2 = sum n |mean|^2 / s^2 over bins of a few."""
    count = np.bincount(of_bin, minlength=len(places))
    sums = [np.bincount(of_bin, error[:, axis], len(places)) for axis in range(2)]
    with np.errstate(invalid="ignore"):
        mean = np.stack(sums, axis=1) / count[:, None]
    judged = count >= _LEAST_CORNERS
    chi2 = (count[judged, None] * mean[judged] ** 2).sum() / max(noise_px, 1e-12) ** 2
    p_value = float(stats.chi2.sf(chi2, 2 * judged.sum())) if judged.any() else 1.0
    return MeanErrors(places, mean, count, p_value)

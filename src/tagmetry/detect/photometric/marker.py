"""One marker: from first corners to a fit, from there to better corners with their covariance."""

import numpy as np

from tagmetry.detect.photometric.behind import reaches_edges, with_surround
from tagmetry.detect.photometric.corners import corners_of_fit
from tagmetry.detect.photometric.fit import fit_pixels
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import BLACK, BLUR, BOWS, COUNT, cells_at
from tagmetry.detect.photometric.pixels import gather
from tagmetry.detect.photometric.straight import straight_place
from tagmetry.geometry import Array, square_to_quad
from tagmetry.geometry.arrays import GreyPixels

_FIRST_BLUR_PX = 0.9
_LEAST_PIXELS = 60


def frame_of(corners_px: Array) -> Array:
    """Return the middle x, y and the half diagonal of a marker, pixels, shape (3,)."""
    middle = corners_px.mean(axis=0)
    return np.append(middle, np.linalg.norm(corners_px - middle, axis=1).mean())


def first_fit(corners: Array, lens: Array, square: tuple[float, float], half_px: float) -> Array:
    """Return the numbers of the model with the homography of first corners.

    Args:
        corners: In the marker's frame, shape (4, 2).
        lens: See `straight_place`.
        square: First and last cell coordinate of the square.
        half_px: Half diagonal, pixels.
    """
    straight = np.array([straight_place(x, y, lens) for x, y in corners])
    low, high = square
    cells = np.array([[high - low, 0.0, low], [0.0, high - low, low], [0.0, 0.0, 1.0]])
    G = cells @ np.linalg.inv(square_to_quad(straight))
    fit = np.zeros(COUNT)
    fit[:8] = (G / G[2, 2]).ravel()[:8]
    fit[BLUR] = fit[BLUR + 2] = (_FIRST_BLUR_PX / half_px) ** 2
    return fit


@kernel
def _levels(start: Array, ink: Array, pixels: Array) -> tuple[float, float]:
    """Return the mean values of pixels on black and on white cells, as a share of 255."""
    sums, counts = np.zeros(2), np.full(2, 1e-9)
    for x, y, seen in pixels:
        u, v, _ = cells_at(start, x, y)
        white = int(ink[int(v), int(u)])
        sums[white] += seen
        counts[white] += 1.0
    levels = np.maximum(sums / counts, 1.0) / 255.0
    return levels[0], levels[1]


@kernel
def fit_marker(
    grey: GreyPixels,
    ink: Array,
    start: Array,
    corners: Array,
    frame: Array,
    lens: Array,
    square: tuple[float, float],
    bows: bool,
) -> tuple[Array, Array, Array, float, float]:
    """Return the fit, the corners (4, 2) and the covariance of corners and bows (13, 13).

    Both in units of the half diagonal, from the middle. After them the noise (grey values), and how
    far the picture moved in the last round (px), infinite where the fit failed.
    """
    failed = np.zeros((13, 13))
    pixels = gather(grey, ink, start, corners, frame, lens, square[1] - square[0])
    if len(pixels) < _LEAST_PIXELS:
        return start, corners, failed, 0.0, np.inf
    start = start.copy()
    start[BLACK], start[BLACK + 1] = _levels(start, ink, pixels)
    most = COUNT if bows else BOWS
    fit, covariance, noise, moved_px = fit_pixels(start, ink, pixels, frame[2], most)
    if np.isfinite(moved_px) and reaches_edges(fit):
        surrounded = with_surround(grey, ink, fit, frame, lens)
        fit, covariance, noise, moved_px = fit_pixels(fit, surrounded, pixels, frame[2], most)
    if not np.isfinite(moved_px):
        return fit, corners, failed, noise, moved_px
    places, by_fit = corners_of_fit(fit, lens, square, corners, most)
    joint = np.zeros((13, most))
    joint[:8] = by_fit
    for k in range(BOWS, most):
        joint[8 + k - BOWS, k] = 1.0
    return fit, places, joint @ covariance @ joint.T, noise, moved_px

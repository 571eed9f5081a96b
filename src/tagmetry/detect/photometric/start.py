"""From first corners to the first numbers of the model."""

import numpy as np

from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import COUNT, LOOKS
from tagmetry.detect.photometric.straight import straight_place
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_LEAST_TURN_PX2 = 4.0


@kernel
def are_squares(corners_px: Array) -> BoolArray:
    """Say which corners go clockwise around an area of some pixels, without a dent, shape (n,)."""
    squares = np.ones(len(corners_px), dtype=np.bool_)
    for k in range(len(corners_px)):
        corners = corners_px[k]
        for side in range(4):
            here, after, last = corners[side], corners[(side + 1) % 4], corners[(side + 2) % 4]
            along_x, along_y = after[0] - here[0], after[1] - here[1]
            turn = along_x * (last[1] - after[1]) - along_y * (last[0] - after[0])
            squares[k] &= turn > _LEAST_TURN_PX2
    return squares


@kernel
def frames_of(corners_px: Array) -> Array:
    """Return the middle x, y and the half diagonal of markers, pixels, shape (n, 3)."""
    frames = np.zeros((len(corners_px), 3))
    for k in range(len(corners_px)):
        for corner in corners_px[k]:
            frames[k, :2] += 0.25 * corner
        for corner in corners_px[k]:
            frames[k, 2] += 0.25 * np.hypot(corner[0] - frames[k, 0], corner[1] - frames[k, 1])
    return frames


@kernel
def first_fits(
    corners_px: Array, frames: Array, lenses: Array, squares: Array, looks: Array
) -> Array:
    """Return the numbers of the model with the homographies of first corners, shape (n, 24).

    Args:
        corners_px: Clockwise from the picture's top left, shape (n, 4, 2).
        frames: Middle x, y and half diagonal of the markers, pixels, shape (n, 3).
        lenses: See `lenses_around`.
        squares: First and last cell coordinate of the squares, shape (n, 2).
        looks: How each looked before; NaN where that is not known, shape (n, 11).
    """
    fits, places = np.zeros((len(corners_px), COUNT)), np.empty((4, 2))
    for k in range(len(corners_px)):
        for corner in range(4):
            x, y = (corners_px[k, corner] - frames[k, :2]) / frames[k, 2]
            places[corner] = straight_place(x, y, lenses[k])
        fits[k, :8] = _quad_to_cells(places, squares[k, 0], squares[k, 1])
        if np.isfinite(looks[k]).all():
            fits[k, LOOKS] = looks[k]
    return fits


@kernel
def _quad_to_cells(corners: Array, low: float, high: float) -> tuple[float, ...]:
    """Return the homography from a quadrilateral to a square of cells; NaN where there is none.

    It is the inverse of that from the unit square (P. Heckbert, 1989), up to scale its adjugate.
    """
    (x0, y0), (x1, y1), (x2, y2), (x3, y3) = corners[0], corners[1], corners[2], corners[3]
    sum_x, sum_y = x0 - x1 + x2 - x3, y0 - y1 + y2 - y3
    dx1, dy1, dx2, dy2 = x1 - x2, y1 - y2, x3 - x2, y3 - y2
    determinant = dx1 * dy2 - dx2 * dy1
    g, h = (sum_x * dy2 - dx2 * sum_y) / determinant, (dx1 * sum_y - sum_x * dy1) / determinant
    a, b, d, e = x1 - x0 + g * x1, x3 - x0 + h * x3, y1 - y0 + g * y1, y3 - y0 + h * y3
    u = e - y0 * h, x0 * h - b, b * y0 - x0 * e
    v = y0 * g - d, a - x0 * g, x0 * d - a * y0
    w = d * h - e * g, b * g - a * h, a * e - b * d
    side, one = high - low, w[2] if abs(a * u[0] + b * v[0] + x0 * w[0]) > 0.0 else np.nan
    return (
        (side * u[0] + low * w[0]) / one,
        (side * u[1] + low * w[1]) / one,
        (side * u[2] + low * w[2]) / one,
        (side * v[0] + low * w[0]) / one,
        (side * v[1] + low * w[1]) / one,
        (side * v[2] + low * w[2]) / one,
        w[0] / one,
        w[1] / one,
    )

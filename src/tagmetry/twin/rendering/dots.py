"""The exact share of a pixel's footprint that a disc covers.

The footprint is a quadrilateral on the sheet. The area that a disc shares with a polygon is the sum
over its sides of the signed area that the disc shares with the triangle (centre, begin, end): of a
piece inside the disc half the cross product of its ends, of a piece outside half the angle between
them by the radius squared.
"""

import numpy as np
from numba import njit

from tagmetry.geometry import Array


def disc_shares(x: Array, y: Array, radius: float) -> Array:
    """Return the share of each of h x w pixels that a disc round the origin covers, shape (h, w).

    Args:
        x: Where the corner rays of the pixels meet the sheet, shape (h + 1, w + 1), any unit; NaN
            where one misses its plane.
        y: The same, in the other direction.
        radius: In the same unit.
    """
    return _shares(np.ascontiguousarray(x / radius), np.ascontiguousarray(y / radius))


@njit(cache=True, nogil=True)
def _shares(x: Array, y: Array) -> Array:
    height, width = x.shape[0] - 1, x.shape[1] - 1
    shares = np.zeros((height, width))
    for row in range(height):
        for column in range(width):
            x0, y0, x1, y1 = x[row, column], y[row, column], x[row, column + 1], y[row, column + 1]
            x2, y2 = x[row + 1, column + 1], y[row + 1, column + 1]
            x3, y3 = x[row + 1, column], y[row + 1, column]
            area = ((x2 - x0) * (y3 - y1) - (x3 - x1) * (y2 - y0)) / 2
            if area != 0 and np.isfinite(area):
                covered = _side(x0, y0, x1, y1) + _side(x1, y1, x2, y2)
                covered += _side(x2, y2, x3, y3) + _side(x3, y3, x0, y0)
                shares[row, column] = min(max(covered / area, 0.0), 1.0)
    return shares


@njit(cache=True, nogil=True)
def _side(x0: float, y0: float, x1: float, y1: float) -> float:
    """Return the signed area that the unit disc shares with the triangle of a side."""
    dx, dy = x1 - x0, y1 - y0
    length2 = dx * dx + dy * dy
    if length2 == 0:
        return 0.0
    nearest = -(x0 * dx + y0 * dy) / length2
    distance2 = (x0 + nearest * dx) ** 2 + (y0 + nearest * dy) ** 2
    half = np.sqrt(max(1.0 - distance2, 0.0) / length2)
    enter = min(max(nearest - half, 0.0), 1.0)
    leave = min(max(nearest + half, 0.0), 1.0)
    xa, ya, xb, yb = x0 + enter * dx, y0 + enter * dy, x0 + leave * dx, y0 + leave * dy
    inside = (xa * yb - xb * ya) / 2
    return float(inside + _sector(x0, y0, xa, ya) + _sector(xb, yb, x1, y1))


@njit(cache=True, nogil=True)
def _sector(x0: float, y0: float, x1: float, y1: float) -> float:
    return float(np.arctan2(x0 * y1 - x1 * y0, x0 * x1 + y0 * y1) / 2)

"""Grey values between pixels, and how an image steps across the sides of squares."""

import numpy as np
from numba import njit

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_ALONG = np.linspace(0.05, 0.95, 10)
_ONE = np.uint64(1)


def steps_across(grey: GreyPixels, corners_px: Array, reach_px: Array) -> Array:
    """Return by how much the image is brighter just outside each side than just inside.

    Args:
        grey: 8-bit image.
        corners_px: Squares, clockwise, shape (n, 4, 2).
        reach_px: How far outside and inside each square's sides is looked at, shape (n,).

    Returns:
        Grey values at ten places along each side, shape (n, 40).
    """
    return _steps(grey, np.ascontiguousarray(corners_px), reach_px)


def side_lengths(corners_px: Array) -> Array:
    """Return the lengths of the sides of squares (n, 4, 2), shape (n, 4), pixels."""
    sides = corners_px[:, [1, 2, 3, 0]] - corners_px
    return np.hypot(sides[..., 0], sides[..., 1])


def cell_means(grey: GreyPixels, H: Array, at: Array, reach: float) -> Array:
    """Return the mean of four places around each point of a square, shape (n, k).

    Args:
        grey: 8-bit image.
        H: From the unit square to pixels, shape (n, 3, 3).
        at: Points of the unit square, shape (k, 2).
        reach: How far beside and above each point it is looked at, sides of the square.
    """
    return _cell_means(grey, np.ascontiguousarray(H), np.ascontiguousarray(at), reach)


@njit(cache=True, nogil=True)
def _cell_means(grey: GreyPixels, H: Array, at: Array, reach: float) -> Array:
    means = np.empty((len(H), len(at)))
    for i in range(len(H)):
        means[i] = cell_means_of(grey, H[i], at, reach)
    return means


@njit(cache=True, nogil=True, error_model="numpy")  # on the horizon 1 / 0 is no place
def cell_means_of(grey: GreyPixels, H: Array, at: Array, reach: float) -> Array:
    """Return what `cell_means` does of one square, shape (k,)."""
    means = np.zeros(len(at))
    for k in range(len(at)):
        for tap in range(4):
            u = at[k, 0] + (reach if tap % 2 else -reach)
            v = at[k, 1] + (reach if tap >= 2 else -reach)
            w = 1 / (H[2, 0] * u + H[2, 1] * v + H[2, 2])
            x = (H[0, 0] * u + H[0, 1] * v + H[0, 2]) * w
            y = (H[1, 0] * u + H[1, 1] * v + H[1, 2]) * w
            means[k] += bilinear(grey, x, y) / 4
    return means


@njit(cache=True, nogil=True)
def _steps(grey: GreyPixels, corners_px: Array, reach_px: Array) -> Array:
    steps = np.empty((len(corners_px), 4 * len(_ALONG)))
    for i in range(len(corners_px)):
        steps[i] = steps_of(grey, corners_px[i], reach_px[i])
    return steps


@njit(cache=True, nogil=True)
def steps_of(grey: GreyPixels, corners_px: Array, reach_px: float) -> Array:
    """Return what `steps_across` does of one square, shape (40,)."""
    count = len(_ALONG)
    steps = np.empty(4 * count)
    for side in range(4):
        x, y = corners_px[side]
        along_x, along_y = corners_px[(side + 1) % 4] - corners_px[side]
        reach = reach_px / max(np.sqrt(along_x**2 + along_y**2), 1e-9)
        out_x, out_y = reach * along_y, -reach * along_x
        for k in range(count):
            on_x, on_y = x + _ALONG[k] * along_x, y + _ALONG[k] * along_y
            outside = bilinear(grey, on_x + out_x, on_y + out_y)
            inside = bilinear(grey, on_x - out_x, on_y - out_y)
            steps[side * count + k] = outside - inside
    return steps


@njit(cache=True, nogil=True)
def bilinear(grey: GreyPixels, x: float, y: float) -> float:
    """Return the grey value between pixels; the image's edge is repeated outside."""
    x = min(max(0.0, x), grey.shape[1] - 1.001)  # in this order, what is no number becomes 0
    y = min(max(0.0, y), grey.shape[0] - 1.001)
    column, row = np.uint64(x), np.uint64(y)
    right, down = x - float(column), y - float(row)
    above, below = grey[row], grey[row + _ONE]
    high = above[column] + right * (float(above[column + _ONE]) - above[column])
    low = below[column] + right * (float(below[column + _ONE]) - below[column])
    return float(high + down * (low - high))

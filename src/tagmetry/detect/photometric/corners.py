"""From the fitted numbers to the marker's corners in the image, and how they move with them."""

import numpy as np

from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import bent_place, cells_at
from tagmetry.detect.photometric.straight import straight_place
from tagmetry.geometry import Array

_SMALL = 1e-5


@kernel
def cells_of_place(fit: Array, lens: Array, x: float, y: float) -> tuple[float, float]:
    """Return the cell coordinates u, v of a place in the image, through lens and bows."""
    x, y = straight_place(x, y, lens)
    bent_x, bent_y = bent_place(fit, x, y)
    u, v, _ = cells_at(fit, bent_x, bent_y)
    return u, v


@kernel
def _slopes(fit: Array, lens: Array, x: float, y: float) -> Array:
    """Return d(u, v) / d(x, y), shape (2, 2)."""
    slopes = np.empty((2, 2))
    right = cells_of_place(fit, lens, x + _SMALL, y)
    left = cells_of_place(fit, lens, x - _SMALL, y)
    low = cells_of_place(fit, lens, x, y + _SMALL)
    high = cells_of_place(fit, lens, x, y - _SMALL)
    for k in range(2):
        slopes[k, 0] = (right[k] - left[k]) / (2 * _SMALL)
        slopes[k, 1] = (low[k] - high[k]) / (2 * _SMALL)
    return slopes


@kernel
def place_of_cells(
    fit: Array, lens: Array, u: float, v: float, x: float, y: float
) -> tuple[float, float, Array]:
    """Return where in the image a cell coordinate lies, by Newton's method, and d(x, y) / d(u, v).

    Args:
        fit: The numbers of the model.
        lens: See `straight_place`.
        u: Cells.
        v: Cells.
        x: First guess.
        y: First guess.
    """
    back = np.zeros((2, 2))
    for _ in range(6):
        at_u, at_v = cells_of_place(fit, lens, x, y)
        back = _inverse(_slopes(fit, lens, x, y))
        x -= back[0, 0] * (at_u - u) + back[0, 1] * (at_v - v)
        y -= back[1, 0] * (at_u - u) + back[1, 1] * (at_v - v)
    return x, y, back


@kernel
def _inverse(M: Array) -> Array:
    determinant = M[0, 0] * M[1, 1] - M[0, 1] * M[1, 0]
    if determinant == 0.0:
        return np.full((2, 2), np.nan)
    return np.asarray(np.array([[M[1, 1], -M[0, 1]], [-M[1, 0], M[0, 0]]]) / determinant)


@kernel
def corners_of_fit(
    fit: Array, lens: Array, square: tuple[float, float], start: Array, count: int
) -> tuple[Array, Array]:
    """Return the corners, (4, 2), and their derivatives by the first `count` numbers, (8, count).

    Args:
        fit: The numbers of the model.
        lens: See `straight_place`.
        square: First and last cell coordinate of the square.
        start: About where the corners are, (4, 2).
        count: 18, or 23 with the bows.
    """
    places, by_fit = np.empty((4, 2)), np.zeros((8, count))
    low, high = square
    for corner in range(4):
        u = high if corner in (1, 2) else low
        v = high if corner > 1 else low
        x, y, back = place_of_cells(fit, lens, u, v, start[corner, 0], start[corner, 1])
        places[corner] = x, y
        for k in range(count):
            shifted = fit.copy()
            shift = _SMALL * max(1.0, abs(fit[k]))
            shifted[k] += shift
            to_u, to_v = cells_of_place(shifted, lens, x, y)
            for axis in range(2):
                by_fit[2 * corner + axis, k] = (
                    -(back[axis, 0] * (to_u - u) + back[axis, 1] * (to_v - v)) / shift
                )
    return places, by_fit

"""From the fitted numbers to the marker's corners in the image, and how they move with them."""

import numpy as np

from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.model import BOWS, bent_place, cells_at
from tagmetry.detect.photometric.straight import straight_place
from tagmetry.geometry import Array

_SMALL = 1e-5
_ROUNDS = 6
_SETTLED = 1e-8


@kernel
def write_corners(
    fit: Array, lens: Array, square: tuple[float, float], places: Array, by_fit: Array
) -> None:
    """Write the corners, and how they move with the numbers of the fit.

    Args:
        fit: The numbers of the model.
        lens: See `straight_place`.
        square: First and last cell coordinate of the square.
        places: Written, half diagonals from the middle, shape (4, 2).
        by_fit: Its first eight rows are written; as many columns as numbers were fitted.
    """
    low, high = square
    for corner in range(4):
        u = high if corner in (1, 2) else low
        v = high if corner > 1 else low
        x, y = place_of_cells(fit, lens, u, v)
        places[corner, 0], places[corner, 1] = x, y
        moved = _cells_by_fit(fit, lens, x, y)
        slopes = _slopes(fit, lens, x, y)
        for k in range(by_fit.shape[1]):
            by_fit[2 * corner, k], by_fit[2 * corner + 1, k] = _solved(
                slopes, -moved[0, k], -moved[1, k]
            )


@kernel
def place_of_cells(fit: Array, lens: Array, u: float, v: float) -> tuple[float, float]:
    """Return where in the image a cell coordinate lies: at once if nothing bends, else by Newton.

    Args:
        fit: The numbers of the model.
        lens: See `straight_place`.
        u: Cells.
        v: Cells.
    """
    across = fit[0] - u * fit[6], fit[1] - u * fit[7]
    down = fit[3] - v * fit[6], fit[4] - v * fit[7]
    x, y = _solved((*across, *down), u - fit[2], v - fit[5])
    for _ in range(_ROUNDS):
        at_u, at_v = _cells_of_place(fit, lens, x, y)
        if abs(at_u - u) + abs(at_v - v) < _SETTLED:
            break
        move_x, move_y = _solved(_slopes(fit, lens, x, y), u - at_u, v - at_v)
        x, y = x + move_x, y + move_y
    return x, y


@kernel
def _cells_of_place(fit: Array, lens: Array, x: float, y: float) -> tuple[float, float]:
    """Return the cell coordinates u, v of a place in the image, through lens and bows."""
    x, y = straight_place(x, y, lens)
    bent_x, bent_y = bent_place(fit, x, y)
    u, v, _ = cells_at(fit, bent_x, bent_y)
    return u, v


@kernel
def _slopes(fit: Array, lens: Array, x: float, y: float) -> tuple[float, float, float, float]:
    """Return du/dx, du/dy, dv/dx, dv/dy."""
    right = _cells_of_place(fit, lens, x + _SMALL, y)
    left = _cells_of_place(fit, lens, x - _SMALL, y)
    low = _cells_of_place(fit, lens, x, y + _SMALL)
    high = _cells_of_place(fit, lens, x, y - _SMALL)
    return (
        (right[0] - left[0]) / (2 * _SMALL),
        (low[0] - high[0]) / (2 * _SMALL),
        (right[1] - left[1]) / (2 * _SMALL),
        (low[1] - high[1]) / (2 * _SMALL),
    )


@kernel
def _solved(M: tuple[float, float, float, float], u: float, v: float) -> tuple[float, float]:
    """Return the solution of M (x, y) = (u, v); M row by row. Not finite where there is none."""
    a, b, c, d = M
    determinant = a * d - b * c
    return (d * u - b * v) / determinant, (a * v - c * u) / determinant


@kernel
def _cells_by_fit(fit: Array, lens: Array, x: float, y: float) -> Array:
    """Return d(u, v) / d fit at a place, shape (2, 24)."""
    x, y = straight_place(x, y, lens)
    bent_x, bent_y = bent_place(fit, x, y)
    u, v, down = cells_at(fit, bent_x, bent_y)
    by_fit = np.zeros((2, len(fit)))
    far, saddle, twist = x * x + y * y - 1.0, x * x - y * y, 2 * x * y
    for k, at in enumerate((u, v)):
        by_fit[k, 3 * k : 3 * k + 3] = bent_x / down, bent_y / down, 1.0 / down
        by_fit[k, 6], by_fit[k, 7] = -at * bent_x / down, -at * bent_y / down
        by_x, by_y = (fit[3 * k] - at * fit[6]) / down, (fit[3 * k + 1] - at * fit[7]) / down
        by_fit[k, BOWS], by_fit[k, BOWS + 1] = far * by_x, far * by_y
        by_fit[k, BOWS + 2] = saddle * by_x - twist * by_y
        by_fit[k, BOWS + 3] = twist * by_x + saddle * by_y
        by_fit[k, BOWS + 4] = far * (by_x * x + by_y * y)
    return by_fit

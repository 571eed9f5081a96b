"""The exact mean colour of a pixel's footprint on a printed sheet.

The four corner rays of a pixel meet the sheet's plane in a quadrilateral Q; the pixel shows the
mean of the sheet's colour f over Q. A sheet is a grid of cells of one colour each, so the integral
is exact by Green's theorem,

    integral over Q of f dA = integral around Q of F dy,  F(x, y) = integral of f(s, y) ds, s <= x,

with F linear in x within a cell: each side of Q is cut where it crosses the grid, and the midpoint
rule is exact on the pieces. A footprint within one cell needs no walk. What remains is that a
pixel's side is taken to be straight on the sheet, and the colour's mean to be taken over the sheet
instead of the pixel: both of the order of a pixel's size by the distance, squared.

Units: cells, x to the right from the sheet's left edge, y down from its top edge.
"""

import numpy as np
from numba import njit

from tagmetry.geometry.arrays import Array


def footprint_means(x: Array, y: Array, cells: Array) -> tuple[Array, Array]:
    """Return each pixel's mean colour and the share of it that the sheet covers.

    Args:
        x: Where the corner rays of h x w pixels meet the sheet, shape (h + 1, w + 1), cells; NaN
            where one misses its plane.
        y: The same, downward.
        cells: Colours, shape (rows, columns).

    Returns:
        The colour times the share, shape (h, w), and the share, shape (h, w), 0 to 1.
    """
    running = np.zeros((cells.shape[0], cells.shape[1] + 1))
    np.cumsum(cells, axis=1, out=running[:, 1:])
    cells = np.ascontiguousarray(cells, dtype=np.float64)
    return _means(np.ascontiguousarray(x), np.ascontiguousarray(y), cells, running)


@njit(cache=True, nogil=True)
def _means(x: Array, y: Array, cells: Array, running: Array) -> tuple[Array, Array]:
    height, width = x.shape[0] - 1, x.shape[1] - 1
    rows, columns = cells.shape
    colour, share = np.zeros((height, width)), np.zeros((height, width))
    for row in range(height):
        for column in range(width):
            x0, y0, x1, y1 = x[row, column], y[row, column], x[row, column + 1], y[row, column + 1]
            x2, y2 = x[row + 1, column + 1], y[row + 1, column + 1]
            x3, y3 = x[row + 1, column], y[row + 1, column]
            left, right = min(x0, x1, x2, x3), max(x0, x1, x2, x3)
            top, bottom = min(y0, y1, y2, y3), max(y0, y1, y2, y3)
            if not (left < columns and right > 0.0 and top < rows and bottom > 0.0):
                continue  # beside the sheet
            area = ((x2 - x0) * (y3 - y1) - (x3 - x1) * (y2 - y0)) / 2
            if area == 0 or not np.isfinite(area):
                continue
            if left >= 0.0 and top >= 0.0 and int(left) == int(right) and int(top) == int(bottom):
                colour[row, column], share[row, column] = cells[int(top), int(left)], 1.0
                continue
            a, p = _walk(x0, y0, x1, y1, running)
            b, q = _walk(x1, y1, x2, y2, running)
            c, r = _walk(x2, y2, x3, y3, running)
            d, s = _walk(x3, y3, x0, y0, running)
            colour[row, column] = (a + b + c + d) / area
            share[row, column] = min(max((p + q + r + s) / area, 0.0), 1.0)
    return colour, share


@njit(cache=True, nogil=True)
def _walk(x0: float, y0: float, x1: float, y1: float, running: Array) -> tuple[float, float]:
    """Integrate F dy along a line, for the colour and for 1 on the sheet."""
    rows, columns = running.shape[0], running.shape[1] - 1
    colour, inside = 0.0, 0.0
    dx, dy = x1 - x0, y1 - y0
    if dy == 0:
        return colour, inside
    begin, end = _clipped(y0, dy, 0.0, float(rows))  # F is zero above and below the sheet
    t = begin
    while t < end:
        row = _cell(y0 + t * dy, dy, rows)
        column = _column(x0 + t * dx, dx, columns)
        leave = min(end, _leaves(y0, dy, row), _leaves_column(x0, dx, column, columns))
        if leave <= t:
            leave = min(end, t + 1e-12)
        middle_x, rise = x0 + (t + leave) / 2 * dx, (leave - t) * dy
        if column >= columns:
            colour += running[row, columns] * rise
            inside += columns * rise
        elif column >= 0:
            within = middle_x - column
            own = running[row, column + 1] - running[row, column]
            colour += (running[row, column] + own * within) * rise
            inside += middle_x * rise
        t = leave
    return colour, inside


@njit(cache=True, nogil=True)
def _clipped(y0: float, dy: float, low: float, high: float) -> tuple[float, float]:
    """Return the part of 0..1 in which y0 + t dy lies between low and high."""
    first, last = (low - y0) / dy, (high - y0) / dy
    if first > last:
        first, last = last, first
    return max(0.0, first), min(1.0, last)


@njit(cache=True, nogil=True)
def _cell(y: float, dy: float, rows: int) -> int:
    """Return the row that a line enters at y; on a grid line, the one that it moves into."""
    row = int(np.floor(y))
    nearest = np.rint(y)
    if abs(y - nearest) < 1e-11:
        row = int(nearest) if dy > 0 else int(nearest) - 1
    return min(max(row, 0), rows - 1)


@njit(cache=True, nogil=True)
def _column(x: float, dx: float, columns: int) -> int:
    """Return the column that a line enters at x: -1 left of the sheet, `columns` right of it."""
    if dx == 0:
        return min(max(int(np.floor(x)), -1), columns)
    nearest = np.rint(x)
    column = int(np.floor(x))
    if abs(x - nearest) < 1e-11:
        column = int(nearest) if dx > 0 else int(nearest) - 1
    return min(max(column, -1), columns)


@njit(cache=True, nogil=True)
def _leaves(y0: float, dy: float, row: int) -> float:
    return (row + 1 - y0) / dy if dy > 0 else (row - y0) / dy


@njit(cache=True, nogil=True)
def _leaves_column(x0: float, dx: float, column: int, columns: int) -> float:
    if dx == 0 or (dx > 0 and column >= columns) or (dx < 0 and column < 0):
        return np.inf
    return (column + 1 - x0) / dx if dx > 0 else (column - x0) / dx

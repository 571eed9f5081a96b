"""The outline of filled cells.

Neighbouring cells become one area with one outline: drawn one by one, they would show hairlines
between them in viewers that smooth edges.
"""

from collections import defaultdict

import numpy as np

from tagmetry.files.sheets.page import Cells
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

Corner = tuple[int, int]  # (column, row), counted along the lines between the cells


def outlines_m(cells: Cells) -> list[Array]:
    """Return the closed outlines of the filled cells, each (n, 2): x and y on the page, metres.

    Filled by the even-odd rule they give the filled cells. Outer ones run clockwise as seen on the
    page, those of holes the other way round. The last point is not the first one again.
    """
    rows, columns = cells.filled.shape
    pitch_m = np.array([cells.box.width_m / columns, cells.box.height_m / rows])
    origin_m = np.array([cells.box.x_m, cells.box.y_m])
    return [origin_m + np.array(loop) * pitch_m for loop in _loops(cells.filled)]


def _loops(filled: BoolArray) -> list[list[Corner]]:
    """Walk along the edges until none is left."""
    following = _edges(filled)
    loops = []
    while following:
        start = next(iter(following))
        loop = [start]
        while (corner := _step(following, loop[-1])) != start:
            loop.append(corner)
        loops.append(_without_straight_corners(loop))
    return loops


def _edges(filled: BoolArray) -> dict[Corner, list[Corner]]:
    """Return where the edges lead from each corner, with the filled side on their right."""
    padded = np.pad(filled, 1)
    above, below = padded[:-1, 1:-1], padded[1:, 1:-1]
    left, right = padded[1:-1, :-1], padded[1:-1, 1:]
    following: dict[Corner, list[Corner]] = defaultdict(list)
    for row, column in np.argwhere(below & ~above).tolist():
        following[column, row].append((column + 1, row))
    for row, column in np.argwhere(above & ~below).tolist():
        following[column + 1, row].append((column, row))
    for row, column in np.argwhere(left & ~right).tolist():
        following[column, row].append((column, row + 1))
    for row, column in np.argwhere(right & ~left).tolist():
        following[column, row + 1].append((column, row))
    return following


def _step(following: dict[Corner, list[Corner]], corner: Corner) -> Corner:
    """Use up an edge that starts at the corner and return where it leads."""
    ends = following[corner]
    end = ends.pop()
    if not ends:
        del following[corner]
    return end


def _without_straight_corners(loop: list[Corner]) -> list[Corner]:
    neighbours = zip(loop[-1:] + loop[:-1], loop, loop[1:] + loop[:1], strict=True)
    return [here for before, here, after in neighbours if not _is_straight(before, here, after)]


def _is_straight(before: Corner, here: Corner, after: Corner) -> bool:
    return before[0] == here[0] == after[0] or before[1] == here[1] == after[1]

"""The outline of a dark area: the way around it along the cracks between dark and bright pixels.

A crack is the border between a dark pixel and one of its four neighbours that is not. The walk goes
clockwise as seen, the dark on its right hand. What its next step is depends on the side of the
pixel that it is at, and on whether the pixel ahead and the one left of that are dark: sixteen
cases, looked up in a table, as no machine can guess which way an outline turns.

Where the outline passes a crack is told by the grey values, taken to change linearly between the
two pixels: far finer than a pixel.
"""

import numpy as np
from numba import njit

from tagmetry.detect.segment.mask import RIM_PX
from tagmetry.detect.segment.starts import Places
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import Array, GreyPixels, IntArray

# Sides of a pixel, as the walk meets them: above, right, below, left; which way it goes along each,
# and which way is out of the pixel.
_AHEAD_X, _AHEAD_Y = np.array([1, 0, -1, 0]), np.array([0, 1, 0, -1])
_OUT_X, _OUT_Y = np.array([0, 1, 0, -1]), np.array([-1, 0, 1, 0])
_WALKED = 2  # mark in the mask of a pixel whose upper crack was walked
_CASES = 4  # of each side: twice whether it is dark ahead, and whether it is so left of that
_TO, _TO_X, _TO_Y, _SIDE, _AHEAD, _LEFT = range(6)  # columns of the table of steps


@njit(cache=True, nogil=True)
def steps(width: int) -> IntArray:
    """Return the table of steps on a mask of a width, shape (16, 6).

    A row for each side and case: how far it is to the next pixel in the flat mask, in columns and
    in rows; the row at which the cases of the next side begin; how far it is from here to
    the pixel ahead then, and to the one left of that.
    """
    table = np.zeros((4 * _CASES, 6), np.int64)
    for k in range(4 * _CASES):
        side, dark_ahead, dark_left = k // _CASES, k % _CASES >= 2, k % 2
        turn = (3 if dark_left else 0) if dark_ahead else 1
        to_x = dark_ahead * (_AHEAD_X[side] + dark_left * _OUT_X[side])
        to_y = dark_ahead * (_AHEAD_Y[side] + dark_left * _OUT_Y[side])
        then = (side + turn) % 4
        table[k, _TO], table[k, _TO_X], table[k, _TO_Y] = to_x + width * to_y, to_x, to_y
        table[k, _SIDE] = _CASES * then
        table[k, _AHEAD] = table[k, _TO] + _AHEAD_X[then] + width * _AHEAD_Y[then]
        table[k, _LEFT] = table[k, _AHEAD] + _OUT_X[then] + width * _OUT_Y[then]
    return table


@njit(cache=True, nogil=True)
def walk(mask: GreyPixels, width: int, table: IntArray, start: Places, cracks: Places) -> int:
    """Walk around a dark area, write its cracks and return how many they are.

    The walk is given up, with 0, as soon as it meets what shows that the outline begins elsewhere:
    a pixel earlier in reading order, or one that was walked before. So no crack is walked much more
    than once, whatever the image holds.

    Args:
        mask: Zeros and ones with a rim of zeros, row after row; pixels are marked in it.
        width: Of a row.
        table: The `steps` of that width.
        start: Column and row in the mask of the area's first pixel in reading order.
        cracks: For the result, column and row in the mask of the dark pixel and which of its sides,
            shape (the longest way that is worth walking, 3).
    """
    x, y, side = start[0], start[1], 0
    first = place = x + width * y
    ahead, left = place + 1, place + 1 - width
    for count in range(len(cracks)):
        mark = 0 if side else _WALKED
        if place < first or mask[place] & mark:
            return count if place == first else 0
        mask[place] |= mark
        cracks[count, 0], cracks[count, 1], cracks[count, 2] = x, y, side // _CASES
        k = side | (2 if mask[ahead] else 0) | (1 if mask[left] else 0)
        ahead, left = place + table[k, _AHEAD], place + table[k, _LEFT]
        x, y, place = x + table[k, _TO_X], y + table[k, _TO_Y], place + table[k, _TO]
        side = table[k, _SIDE]
    return 0


@njit(cache=True, nogil=True)
def midway(cracks: Places, every: int, points: Array) -> None:
    """Fill `points` with the middles of one in `every` cracks (n, 3), pixels of the image."""
    for i in range(len(points)):
        x, y, side = cracks[i * every]
        points[i, 0] = x - RIM_PX + 0.5 * _OUT_X[side]
        points[i, 1] = y - RIM_PX + 0.5 * _OUT_Y[side]


@njit(cache=True, nogil=True)
def at_level(cracks: Places, grey: GreyPixels, levels: GreyPixels, points: Array) -> None:
    """Fill `points` with the places where the image passes the level on its way across each crack.

    Args:
        cracks: As `walk` gives them, shape (n, 3).
        grey: The image that the mask was made of, shape (h, w).
        levels: Below which each tile's pixels are dark.
        points: For the result, pixels of the image, shape (n, 2).
    """
    for i in range(len(cracks)):
        x, y, side = cracks[i, 0] - RIM_PX, cracks[i, 1] - RIM_PX, cracks[i, 2]
        out_x, out_y = _OUT_X[side], _OUT_Y[side]
        share = _crossing(grey, levels, x, y, out_x, out_y)
        points[i, 0] = x + share * out_x
        points[i, 1] = y + share * out_y


@njit(cache=True, nogil=True)
def _crossing(
    grey: GreyPixels, levels: GreyPixels, x: int, y: int, out_x: int, out_y: int
) -> float:
    """Return how far from a dark pixel to its neighbour the level is passed, 0 to 1."""
    beside_x, beside_y = x + out_x, y + out_y
    if not (0 <= beside_x < grey.shape[1] and 0 <= beside_y < grey.shape[0]):
        return 0.5
    dark, bright = float(grey[y, x]), float(grey[beside_y, beside_x])
    if bright <= dark:
        return 0.5
    level = levels[y // TILE_PX, x // TILE_PX] - 0.5
    return float(min(max((level - dark) / (bright - dark), 0.0), 1.0))

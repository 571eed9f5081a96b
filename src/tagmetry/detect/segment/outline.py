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
from numpy.typing import NDArray

from tagmetry.detect.segment.dark import RIM_PX, Bits
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import Array, GreyPixels

Cracks = NDArray[np.uint64]  # four times the place of the dark pixel's bit, and which of its sides
Steps = NDArray[np.uint64]
# Sides of a pixel, as the walk meets them: above, right, below, left; which way it goes along each,
# and which way is out of the pixel.
_AHEAD_X, _AHEAD_Y = np.array([1, 0, -1, 0]), np.array([0, 1, 0, -1])
_OUT_X, _OUT_Y = np.array([0, 1, 0, -1]), np.array([-1, 0, 1, 0])
_CASES = 4  # of each side: twice whether it is dark ahead, and whether it is so left of that
_AHEAD_ONLY = 2  # the case of the upper side after which the walk goes straight on
_TO, _SIDE, _AHEAD, _LEFT = range(4)  # rows of the table of steps
_ZERO, _ONE, _TWO, _THREE, _SEVEN = (np.uint64(n) for n in (0, 1, 2, 3, 7))


@njit(cache=True, nogil=True)
def steps(width: int) -> Steps:
    """Return the table of steps on bits of a width, shape (4, 16).

    A column for each side and case: how far it is to the next pixel's place; the column at which
    the cases of the next side begin; how far it is from here to the pixel ahead then, and to the
    one left of that. Ways back are what comes to the same in unsigned numbers.
    """
    table = np.zeros((4, 4 * _CASES), np.int64)
    for k in range(4 * _CASES):
        side, dark_ahead, dark_left = k // _CASES, k % _CASES >= 2, k % 2
        turn = (3 if dark_left else 0) if dark_ahead else 1
        to_x = dark_ahead * (_AHEAD_X[side] + dark_left * _OUT_X[side])
        to_y = dark_ahead * (_AHEAD_Y[side] + dark_left * _OUT_Y[side])
        then = (side + turn) % 4
        table[_TO, k], table[_SIDE, k] = to_x + width * to_y, _CASES * then
        table[_AHEAD, k] = table[_TO, k] + _AHEAD_X[then] + width * _AHEAD_Y[then]
        table[_LEFT, k] = table[_AHEAD, k] + _OUT_X[then] + width * _OUT_Y[then]
    return table.view(np.uint64)


@njit(cache=True, nogil=True)
def walk(bits: Bits, marks: Bits, table: Steps, start: np.uint64, cracks: Cracks) -> int:
    """Walk around a dark area, write its cracks and return how many they are.

    The walk is given up, with 0, as soon as it meets what shows that the outline begins elsewhere:
    a pixel earlier in reading order, or one that was walked before. So no crack is walked much more
    than once, whatever the image holds.

    Args:
        bits: What is dark, one row after another.
        marks: Of the same size: a pixel is marked where its upper crack was walked.
        table: The `steps` of the width of a row.
        start: Place of the area's first pixel in reading order.
        cracks: For the result, shape (the longest way that is worth walking,).
    """
    place, side = start, _ZERO
    ahead = place + table[_AHEAD, _AHEAD_ONLY] - table[_TO, _AHEAD_ONLY]
    left = place + table[_LEFT, _AHEAD_ONLY] - table[_TO, _AHEAD_ONLY]
    for count in range(len(cracks)):
        mark = np.uint64(side == _ZERO) << (place & _SEVEN)
        if place < start or marks[place >> _THREE] & mark:
            return count if place == start else 0
        marks[place >> _THREE] |= mark
        cracks[count] = place << _TWO | side >> _TWO
        k = side | _bit(bits, ahead) << _ONE | _bit(bits, left)
        ahead, left = place + table[_AHEAD, k], place + table[_LEFT, k]
        place, side = place + table[_TO, k], table[_SIDE, k]
    return 0


@njit(cache=True, nogil=True)
def _bit(bits: Bits, place: np.uint64) -> np.uint64:
    return np.uint64(bits[place >> _THREE] >> (place & _SEVEN) & _ONE)


@njit(cache=True, nogil=True)
def crack_at(crack: np.uint64, shift: int) -> tuple[int, int, int]:
    """Return a crack's dark pixel, column and row of the image, and which side of that it is.

    Args:
        crack: As `walk` writes it.
        shift: By which a place tells its row.
    """
    place = int(crack >> _TWO)
    return (place & ((1 << shift) - 1)) - RIM_PX, (place >> shift) - RIM_PX, int(crack & _THREE)


@njit(cache=True, nogil=True)
def midway(cracks: Cracks, shift: int, every: int, points: Array) -> None:
    """Fill `points` (m, 2) with the middles of one in `every` cracks, pixels of the image."""
    for i in range(len(points)):
        x, y, side = crack_at(cracks[i * every], shift)
        points[i, 0] = x + 0.5 * _OUT_X[side]
        points[i, 1] = y + 0.5 * _OUT_Y[side]


@njit(cache=True, nogil=True)
def at_level(
    cracks: Cracks, shift: int, every: int, grey: GreyPixels, levels: GreyPixels, points: Array
) -> None:
    """Fill `points` with the places where the image passes the level on its way across cracks.

    Args:
        cracks: As `walk` writes them, shape (n,).
        shift: By which a place tells its row.
        every: One in so many cracks is asked for.
        grey: The image, shape (h, w).
        levels: Below which each tile's pixels are dark.
        points: For the result, pixels of the image, shape (m, 2).
    """
    for i in range(len(points)):
        x, y, side = crack_at(cracks[i * every], shift)
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

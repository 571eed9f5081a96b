"""The outline of a dark area: the way around it along the cracks between dark and bright pixels.

A crack is the border between a dark pixel and one of its four neighbours that is not. Two walks
begin above the area's first pixel, one clockwise as seen and one the other way, and go on in step
until they meet: a machine does two things at once where neither waits for the other. What the next
step is depends on the side of the pixel that the walk is at, and on whether the pixel ahead and the
one outward of that are dark: sixteen cases, looked up in a table, as no machine can guess which way
an outline turns.

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
# Sides of a pixel: above, right, below, left; which way a clockwise walk goes along each, and which
# way is out of the pixel.
_AHEAD_X, _AHEAD_Y = np.array([1, 0, -1, 0]), np.array([0, 1, 0, -1])
_OUT_X, _OUT_Y = np.array([0, 1, 0, -1]), np.array([-1, 0, 1, 0])
_CASES = 4  # of each side: twice whether it is dark ahead, and whether it is so outward of that
_TO, _AHEAD, _OUTWARD = range(3)  # columns of the table of steps
_ONE, _TWO, _THREE, _SEVEN = (np.uint64(n) for n in (1, 2, 3, 7))


@njit(cache=True, nogil=True)
def steps(width: int, way: int) -> Steps:
    """Return the table of steps on bits of a width, shape (16, 4).

    A row for each side and case: how far it is to the next crack; how far it is from the pixel here
    to the pixel ahead then, and to the one outward of that. Ways back are what comes to the same in
    unsigned numbers. An empty column makes rows a power of two long: they are found sooner.

    Args:
        width: How many bits are in a row.
        way: 1 for steps clockwise as seen, -1 for steps the other way.
    """
    table = np.zeros((4 * _CASES, 4), np.int64)
    for k in range(4 * _CASES):
        side, dark_ahead, dark_outward = k // _CASES, k % _CASES >= 2, k % 2
        turn = (-way if dark_outward else 0) if dark_ahead else way
        to_x = dark_ahead * (way * _AHEAD_X[side] + dark_outward * _OUT_X[side])
        to_y = dark_ahead * (way * _AHEAD_Y[side] + dark_outward * _OUT_Y[side])
        to, then = to_x + width * to_y, (side + turn) % 4
        table[k, _TO] = 4 * to + then - side
        table[k, _AHEAD] = to + way * (_AHEAD_X[then] + width * _AHEAD_Y[then])
        table[k, _OUTWARD] = table[k, _AHEAD] + _OUT_X[then] + width * _OUT_Y[then]
    return table.view(np.uint64)


@njit(cache=True, nogil=True)
def walk(
    bits: Bits, up: np.uint64, onward: Steps, backward: Steps, start: np.uint64, cracks: Cracks
) -> tuple[int, int]:
    """Walk around a dark area and write its cracks.

    The walks are given up as soon as one meets a pixel earlier in reading order: the outline begins
    elsewhere. As both set out at once, that is after no more steps than the shorter way takes, and
    n cracks are walked n log n times at worst, whatever the image holds.

    Args:
        bits: What is dark, one row after another.
        up: How many bits are in a row.
        onward: The `steps` of such rows, clockwise.
        backward: The `steps` the other way.
        start: Place of the area's first pixel in reading order.
        cracks: For the result, shape (the longest way that is worth walking,).

    Returns:
        Where in `cracks` they begin and end, clockwise; nothing is between when it was given up.
    """
    middle = len(cracks) // 2
    there = back = first = start << _TWO
    ahead, outward = start + _ONE, start + _ONE - up
    behind, outward_behind = start - _ONE, start - _ONE - up
    for k in range(middle):
        cracks[middle + k] = there
        there, ahead, outward = _step(bits, onward, there, ahead, outward)
        back, behind, outward_behind = _step(bits, backward, back, behind, outward_behind)
        cracks[middle - k - 1] = back
        if there == back:
            return middle - k - 1, middle + k + 1
        if min(there, back) < first:
            return middle, middle  # leaving the loop by `break` instead takes a quarter longer
    return middle, middle


@njit(cache=True, nogil=True)
def _step(
    bits: Bits, cases: Steps, crack: np.uint64, ahead: np.uint64, outward: np.uint64
) -> tuple[np.uint64, np.uint64, np.uint64]:
    """Return the next crack, and the places of the pixel ahead then and of that outward of it."""
    case = (crack & _THREE) << _TWO | _bit(bits, ahead) << _ONE | _bit(bits, outward)
    place = crack >> _TWO
    return crack + cases[case, _TO], place + cases[case, _AHEAD], place + cases[case, _OUTWARD]


@njit(cache=True, nogil=True)
def _bit(bits: Bits, place: np.uint64) -> np.uint64:
    return np.uint64(bits[place >> _THREE] >> (place & _SEVEN) & _ONE)


@njit(cache=True, nogil=True)
def box(cracks: Cracks, shift: int) -> tuple[int, int]:
    """Return width and height of what cracks (n,) go around, pixels.

    Args:
        cracks: As `walk` writes them.
        shift: By which a place tells its row.
    """
    row = np.uint64(shift + 2)
    in_row = (_ONE << row) - _ONE
    left, right = in_row, in_row - in_row
    top, bottom = cracks[0], cracks[0]
    for i in range(len(cracks)):
        x = cracks[i] & in_row
        left, right = min(left, x), max(right, x)
        top, bottom = min(top, cracks[i]), max(bottom, cracks[i])
    across, down = (right >> _TWO) - (left >> _TWO), (bottom >> row) - (top >> row)
    return int(across) + 1, int(down) + 1


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
    last_x, last_y = grey.shape[1] - 1, grey.shape[0] - 1
    for i in range(len(points)):
        x, y, side = crack_at(cracks[i * every], shift)
        out_x, out_y = _OUT_X[side], _OUT_Y[side]
        beside_x, beside_y = min(max(x + out_x, 0), last_x), min(max(y + out_y, 0), last_y)
        dark, bright = _pixel(grey, x, y), _pixel(grey, beside_x, beside_y)
        share = _crossing(dark, bright, _pixel(levels, x // TILE_PX, y // TILE_PX))
        points[i, 0] = x + share * out_x
        points[i, 1] = y + share * out_y


@njit(cache=True, nogil=True)
def _pixel(grey: GreyPixels, x: int, y: int) -> float:
    """Return a pixel that is in the image; no number is taken for one from its end."""
    return float(grey[np.uint64(y), np.uint64(x)])


@njit(cache=True, nogil=True)
def _crossing(dark: float, bright: float, level: float) -> float:
    """Return how far from a dark pixel to its neighbour the level is passed, 0 to 1."""
    if bright <= dark:
        return 0.5  # beside it the image ends
    return float(min(max((level - 0.5 - dark) / (bright - dark), 0.0), 1.0))

"""Where outlines may begin: each outline's first pixel in reading order is one of these.

It is dark, the pixels left of it and above it are not, and below there is more of it. It stands
where the image steps from bright to dark by a good part of the range around it: where texture
crosses its level it mostly steps by less.
"""

import numpy as np
from numba import njit

from tagmetry.detect.reading.closest import count_ones
from tagmetry.detect.segment.dark import RIM_PX, Bits, Places, row_shift
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers.packed import Words

_REACH_PX = 3  # how far above and left of an outline it is looked for bright pixels
_ONE, _TWO, _THREE, _FOUR, _LAST = (np.uint64(n) for n in (1, 2, 3, 4, 63))
_HIGHEST = _ONE << _LAST
_TILE_SHIFT = np.uint64(2)  # a column by a tile's four pixels
_Rows = tuple[GreyPixels, GreyPixels, GreyPixels, GreyPixels, GreyPixels]


@njit(cache=True, nogil=True)
def starts(bits: Bits, grey: GreyPixels, ranges: GreyPixels, share: float, most: int) -> Places:
    """Return where outlines may begin, in reading order: places among the bits, shape (n,).

    Args:
        bits: What is dark.
        grey: The image it was made of, shape (h, w).
        ranges: Of the grey values around each tile.
        share: By how much of it the image must step.
        most: How many are worth the time; the rest is left away.
    """
    words, shift = bits.view(np.uint64), row_shift(bits)
    firsts = np.empty(words.shape[1], np.uint64)
    found = np.empty(most + 1, np.uint64)
    count = 0
    for row in range(RIM_PX, len(words) - RIM_PX):
        _write_firsts(words[row], words[row - 1], words[row + 1], firsts)
        rows, least = _rows_around(grey, row - RIM_PX), ranges[(row - RIM_PX) // TILE_PX]
        for i in range(firsts.size):
            left = firsts[i]
            while left and count < most:
                column = 64 * i + count_ones((left & (~left + _ONE)) - _ONE)
                left &= left - _ONE
                found[count] = row << shift | column
                count += _steps_down(rows, least, share, np.uint64(column - RIM_PX))
    return found[:count]


@njit(cache=True, nogil=True)
def _write_firsts(here: Words, above: Words, below: Words, firsts: Words) -> None:
    """Write which bits of a row are the first of a run of ones with none above and one below it.

    Those beside it are told within eight bits and a word; a run with one above farther on is given
    up when it is walked, and one that goes on in the next word may have one below.
    """
    for i in range(firsts.size):
        run, covered, borne = here[i], here[i] & above[i], here[i] & (below[i] | _HIGHEST)
        covered, borne = covered | run & covered >> _ONE, borne | run & borne >> _ONE
        run &= run >> _ONE
        covered, borne = covered | run & covered >> _TWO, borne | run & borne >> _TWO
        run &= run >> _TWO
        covered, borne = covered | run & covered >> _FOUR, borne | run & borne >> _FOUR
        firsts[i] = borne & ~(here[i] << _ONE | covered)
    for i in range(firsts.size - 1):
        firsts[i + 1] &= ~(here[i] >> _LAST)


@njit(cache=True, nogil=True)
def _rows_around(grey: GreyPixels, y: int) -> _Rows:
    """Return a row of an image, the three above it and the one below; the same one at the edge."""
    last = len(grey) - 1
    return (
        grey[y],
        grey[max(y - 1, 0)],
        grey[max(y - 2, 0)],
        grey[max(y - 3, 0)],
        grey[min(y + 1, last)],
    )


@njit(cache=True, nogil=True)
def _steps_down(rows: _Rows, ranges: GreyPixels, share: float, x: np.uint64) -> bool:
    """Say whether pixels above or left of one are brighter than those below by a share."""
    here, above_1, above_2, above_3, below = rows
    if not _REACH_PX <= x < len(here) - 1:
        return True  # the image's edge may be a marker's
    above = max(above_1[x], above_2[x], above_3[x])
    left = max(here[x - _ONE], here[x - _TWO], here[x - _THREE])
    dark = min(below[x - _ONE], below[x], below[x + _ONE])
    return int(max(above, left)) - int(dark) >= int(share * ranges[x >> _TILE_SHIFT])

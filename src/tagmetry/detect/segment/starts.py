"""Where outlines may begin: each outline's first pixel in reading order is one of these.

It is dark, and the pixels left of it and above it are not. It stands where the image steps from
bright to dark by a good part of the range around it: where texture crosses its level it mostly
steps by less.
"""

import numpy as np
from numba import njit

from tagmetry.detect.reading.closest import count_ones
from tagmetry.detect.segment.dark import RIM_PX, Bits, Places, row_shift
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers.packed import Words

_REACH_PX = 3  # how far above and left of an outline it is looked for bright pixels
_ONE, _TWO, _FOUR, _LAST = np.uint64(1), np.uint64(2), np.uint64(4), np.uint64(63)


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
        _write_firsts(words[row], words[row - 1], firsts)
        for i in range(firsts.size):
            left = firsts[i]
            while left and count < most:
                column = 64 * i + count_ones((left & (~left + _ONE)) - _ONE)
                left &= left - _ONE
                found[count] = row << shift | column
                count += _steps_down(grey, ranges, share, column - RIM_PX, row - RIM_PX)
    return found[:count]


@njit(cache=True, nogil=True)
def _write_firsts(here: Words, above: Words, firsts: Words) -> None:
    """Write which bits of a row are the first of a run of ones that has none above it.

    Those above are told within eight bits; a run with one farther on is given up when it is walked.
    """
    for i in range(firsts.size):
        run, covered = here[i], here[i] & above[i]
        covered |= run & covered >> _ONE
        run &= run >> _ONE
        covered |= run & covered >> _TWO
        run &= run >> _TWO
        covered |= run & covered >> _FOUR
        firsts[i] = here[i] & ~(here[i] << _ONE | covered)
    for i in range(firsts.size - 1):
        firsts[i + 1] &= ~(here[i] >> _LAST)


@njit(cache=True, nogil=True)
def _steps_down(grey: GreyPixels, ranges: GreyPixels, share: float, x: int, y: int) -> bool:
    """Say whether pixels above or left of one are brighter than those below by a share."""
    height, width = grey.shape
    if not (_REACH_PX <= x < width - 1 and _REACH_PX <= y < height - 1):
        return True  # the image's edge may be a marker's
    above = max(grey[y - 1, x], grey[y - 2, x], grey[y - 3, x])
    left = max(grey[y, x - 1], grey[y, x - 2], grey[y, x - 3])
    dark = min(grey[y + 1, x - 1], grey[y + 1, x], grey[y + 1, x + 1])
    least = int(share * ranges[y // TILE_PX, x // TILE_PX])
    return int(max(above, left)) - int(dark) >= least

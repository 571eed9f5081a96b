"""Where outlines may begin: each outline's first pixel in reading order is one of these.

It is dark, and the pixels left of it and above it are not. It stands where the image steps from
bright to dark by a good part of the range around it: where texture crosses its level it mostly
steps by less.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tagmetry.detect.segment.mask import RIM_PX
from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import GreyPixels

Places = NDArray[np.int32]
_ABOVE_PX = 3  # how far above an outline it is looked for bright pixels


@njit(cache=True, nogil=True)
def starts(mask: GreyPixels, grey: GreyPixels, least_steps: GreyPixels, most: int) -> Places:
    """Return where outlines may begin, in reading order: columns and rows of the mask, (n, 2).

    Args:
        mask: Zeros and ones with a rim of zeros, shape (h + 2, a multiple of 8).
        grey: The image it was made of, shape (h, w).
        least_steps: By how much the image must step in each tile, grey values.
        most: How many are worth the time; the rest is left away.
    """
    height, width = grey.shape
    found = np.empty((most, 2), np.int32)
    count = 0
    least = np.empty(TILE_PX * least_steps.shape[1], np.uint8)
    clear, first = np.ones(width, np.uint8), np.zeros(mask.shape[1], np.uint8)
    for y in range(height):
        if y % TILE_PX == 0:
            least[:] = np.repeat(least_steps[y // TILE_PX], TILE_PX)
        if y >= _ABOVE_PX:  # the image's edge may be a marker's
            below = grey[min(y + 1, height - 1)]
            _steps_down(grey[y], grey[y - 1], grey[y - 2], grey[y - 3], below, least, clear)
        _first_pixels(mask[y + RIM_PX], mask[y + RIM_PX - 1], clear, first[RIM_PX:])
        count = _collect(first, y + RIM_PX, found, count)
    return found[:count]


@njit(cache=True, nogil=True)
def _collect(first: GreyPixels, row: int, found: Places, count: int) -> int:
    """Add the columns of ones to what was found, as far as there is room, and return its number."""
    eights = first.view(np.uint64)
    for i in range(eights.size):
        if eights[i]:
            for x in range(8 * i, 8 * i + 8):
                if first[x] and count < len(found):
                    found[count, 0], found[count, 1] = x, row
                    count += 1
    return count


@njit(cache=True, nogil=True)
def _steps_down(
    here: GreyPixels,
    above: GreyPixels,
    higher: GreyPixels,
    highest: GreyPixels,
    below: GreyPixels,
    least: GreyPixels,
    clear: GreyPixels,
) -> None:
    """Write 1 where pixels above or left of a row's are brighter than those below by `least`.

    Loops of few arrays and no negative offsets: the compiler turns these into vectors.
    """
    for x in range(clear.size):
        clear[x] = max(above[x], higher[x], highest[x])
    for x in range(clear.size - 3):
        clear[x + 3] = max(clear[x + 3], here[x], here[x + 1], here[x + 2])
    for x in range(clear.size - 2):
        dark = min(below[x], below[x + 1], below[x + 2])
        clear[x + 1] = max(clear[x + 1], dark) - dark
    for x in range(clear.size):
        clear[x] = clear[x] >= least[x]
    clear[0] = clear[-1] = 1


@njit(cache=True, nogil=True)
def _first_pixels(
    here: GreyPixels, above: GreyPixels, clear: GreyPixels, first: GreyPixels
) -> None:
    """Write 1 at clear pixels of a row of the mask that are dark, but not those left and above."""
    for x in range(clear.size):
        first[x] = here[x + RIM_PX] & clear[x] & ~(here[x] | above[x + RIM_PX])

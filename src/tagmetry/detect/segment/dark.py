"""The dark pixels of an image, one bit each: so many fit where a processor reads them soonest.

A row of them is a power of two of bits, so that the place of a bit among all of them tells row and
column by a shift. Around the image is a rim of zeros: nothing that walks on the bits leaves them.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tagmetry.detect.segment.tiles import TILE_PX
from tagmetry.geometry.arrays import GreyPixels, IntArray

Bits = NDArray[np.uint8]
Places = NDArray[np.uint64]  # of bits among all of them
RIM_PX = 1
_LEAST_SHIFT = 6  # rows are whole words of 64 bits
_ONE, _LAST = np.uint64(1), np.uint64(63)
_FOUR_TIMES = np.uint32(0x01010101)  # a byte times this: four of it
_GATHER = np.uint64(0x0102040810204080)  # times eight bytes of 0 or 1: these as the highest byte
_HIGHEST = np.uint64(56)


@njit(cache=True, nogil=True)
def dark_bits(grey: GreyPixels, levels: GreyPixels) -> Bits:
    """Return 1 where a pixel is darker than its tile's level, else 0.

    Args:
        grey: Shape (h, w).
        levels: Of each tile, shape (ceil(h / 4), ceil(w / 4)).

    Returns:
        Eight pixels a byte, the first the lowest bit, shape (h + 2, m), m a power of two; pixel
        (0, 0) is bit (1, 1).
    """
    height, width = grey.shape
    bits = np.zeros((height + 2 * RIM_PX, _row_bytes(width)), np.uint8)
    row = np.zeros(8 * bits.shape[1], np.uint8)
    eights = row.view(np.uint64)
    level = np.empty(TILE_PX * levels.shape[1], np.uint8)
    fours = level.view(np.uint32)
    for y in range(height):
        if y % TILE_PX == 0:
            for i in range(fours.size):
                fours[i] = levels[y // TILE_PX, i] * _FOUR_TIMES
        here, into, packed = grey[y], row[RIM_PX:], bits[y + RIM_PX]
        for x in range(width):
            into[x] = here[x] < level[x]
        for i in range(packed.size):
            packed[i] = (eights[i] * _GATHER) >> _HIGHEST
    return bits


@njit(cache=True, nogil=True)
def thinned(bits: Bits) -> Bits:
    """Return 1 where all of the three by three bits around are 1; the rim must be zeros."""
    words = bits.view(np.uint64)
    thin = np.zeros_like(words)
    column = np.zeros(words.shape[1] + 2, np.uint64)
    for row in range(1, len(words) - 1):
        for i in range(words.shape[1]):
            column[i + 1] = words[row - 1, i] & words[row, i] & words[row + 1, i]
        for i in range(words.shape[1]):
            left = column[i + 1] << _ONE | column[i] >> _LAST
            right = column[i + 1] >> _ONE | column[i + 2] << _LAST
            thin[row, i] = column[i + 1] & left & right
    return thin.view(np.uint8)


@njit(cache=True, nogil=True)
def row_shift(bits: Bits) -> int:
    """Return the number by which a bit's place is shifted to tell its row."""
    shift = _LEAST_SHIFT
    while 1 << shift < 8 * bits.shape[1]:
        shift += 1
    return shift


def columns_and_rows(places: Places, bits: Bits) -> IntArray:
    """Return where bits stand in the image, shape (n, 2)."""
    rows, columns = np.divmod(places.astype(np.intp), 8 * bits.shape[1])
    return np.stack([columns, rows], axis=1) - RIM_PX


@njit(cache=True, nogil=True)
def _row_bytes(width: int) -> int:
    size = 1 << (_LEAST_SHIFT - 3)
    while 8 * size < width + 2 * RIM_PX:
        size *= 2
    return size

"""Runs: the stretches of dark pixels of each row. All later steps count runs, not pixels."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tagmetry.geometry.arrays import GreyPixels

Int32s = NDArray[np.int32]
_ALL_DARK = np.uint64(0x0101010101010101)


def runs(mask: GreyPixels, most: int) -> tuple[Int32s, Int32s, Int32s] | None:
    """Return the runs of a mask in reading order; None when there are more than `most`.

    Args:
        mask: Zeros and ones with a rim of zeros, shape (rows, a multiple of 8).
        most: How many runs are worth the time.

    Returns:
        The index of the first run of each row, shape (rows + 1,), and of each run its first column
        and the column after its last, shapes (n,).
    """
    first, begins, ends, count = _runs(mask, mask.view(np.uint64), most)
    return None if count > most else (first, begins[:count], ends[:count])


@njit(cache=True, nogil=True)
def _runs(
    mask: GreyPixels, words: NDArray[np.uint64], most: int
) -> tuple[Int32s, Int32s, Int32s, int]:
    """Look at eight pixels at a time, and at single ones only where a run begins or ends."""
    rows = mask.shape[0]
    first = np.zeros(rows + 1, np.int32)
    begins, ends = np.empty(most + 8, np.int32), np.empty(most + 8, np.int32)
    count = 0
    for row in range(rows):
        before = np.uint8(0)
        pixels = mask[row]
        for i in range(words.shape[1]):
            word = words[row, i]
            if word == before * _ALL_DARK:
                continue
            for x in range(8 * i, 8 * i + 8):
                if pixels[x] != before:
                    if before == 0:
                        begins[count] = x
                    else:
                        ends[count] = x
                        count += 1
                    before = pixels[x]
            if count > most:
                return first, begins, ends, count
        first[row + 1] = count
    return first, begins, ends, count

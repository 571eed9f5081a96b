"""The printed pictures of markers, and the part of one that a pixel sees."""

import numpy as np

from tagmetry.detect.photometric.kernel import Narrow, kernel
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

QUIET_CELLS = 2  # rings of white that are put around the picture


def printed(picture: BoolArray) -> Array:
    """Return a marker's cells, 1 is white, with white around them."""
    ink = np.ones((len(picture) + 2 * QUIET_CELLS, len(picture) + 2 * QUIET_CELLS))
    ink[QUIET_CELLS:-QUIET_CELLS, QUIET_CELLS:-QUIET_CELLS] = picture
    return ink


@kernel
def changes(ink: Array) -> Narrow:
    """Return the cells, their changes from row to row, column to column, and of both.

    Shape (2, 2, m, m): first whether rows, then whether columns are compared.
    """
    cells = len(ink)
    all_changes = np.zeros((2, 2, cells, cells), dtype=np.float32)
    for j in range(cells):
        for i in range(cells):
            here, left = ink[j, i], ink[j, max(i - 1, 0)]
            above, before = ink[max(j - 1, 0), i], ink[max(j - 1, 0), max(i - 1, 0)]
            all_changes[0, 0, j, i] = here
            all_changes[0, 1, j, i] = here - left
            all_changes[1, 0, j, i] = here - above
            all_changes[1, 1, j, i] = here - left - above + before
    return all_changes

"""The code of the original ArUco markers, as seed 003 explains it (its figure 5).

Each of the five rows holds two data bits between three parity bits: parity, data, parity, data,
parity. The ten data bits, row by row, are the id: 0000011110 is 30.

The four possible rows (first data bit, second data bit -> row) are 00 -> 10000, 01 -> 10111,
10 -> 01001, 11 -> 01110, white is 1. The parity columns that seed 003 prints are not those of this
marker (its row for 00 reads 00000); the data columns are.
"""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import BoolArray

_ROWS = np.array(
    [[1, 0, 0, 0, 0], [1, 0, 1, 1, 1], [0, 1, 0, 0, 1], [0, 1, 1, 1, 0]],
    dtype=bool,
)


def original_code(marker_id: int) -> BoolArray:
    """Return the 5x5 bits of an original ArUco marker, True is white, shape (25,)."""
    if not 0 <= marker_id < 1024:
        raise InputError(f"original ArUco ids are 0 to 1023, got {marker_id}")
    pairs = [(marker_id >> shift) & 3 for shift in (8, 6, 4, 2, 0)]
    return _ROWS[pairs].reshape(25)


def original_id(code: BoolArray) -> int | None:
    """Return the id that 25 upright bits spell, or None when a row's parity is wrong."""
    marker_id = 0
    for row in code.reshape(5, 5):
        pair = 2 * int(row[1]) + int(row[3])
        if not np.array_equal(row, _ROWS[pair]):
            return None
        marker_id = 4 * marker_id + pair
    return marker_id

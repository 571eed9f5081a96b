"""Markers of which it is known which they are, and about where."""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.rows import Rows
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray

_MOST_IDS = 2**32  # of a family


@dataclass(frozen=True, eq=False)
class Named(Rows):
    """n markers, a row each.

    Attributes:
        families: Places of their families in the detector's list, shape (n,).
        ids: Shape (n,).
        is_inverted: White on black, shape (n,).
        corners_px: Clockwise from the marker's own top left, good to about a pixel, shape
            (n, 4, 2).
        hamming: Wrong bits, shape (n,).
        confidence: Mean clearness of all cells, 0 to 1, shape (n,).
    """

    families: IntArray
    ids: IntArray
    is_inverted: BoolArray
    corners_px: Array
    hamming: IntArray
    confidence: Array

    @property
    def count_of_each(self) -> IntArray:
        """How often the family and id of each are there, shape (n,)."""
        keys = self.families * _MOST_IDS + self.ids
        in_order = np.sort(keys)
        if not (in_order[1:] == in_order[:-1]).any():
            return np.ones(len(keys), dtype=np.int64)
        _, which, counts = np.unique(keys, return_inverse=True, return_counts=True)
        return np.asarray(counts[which])

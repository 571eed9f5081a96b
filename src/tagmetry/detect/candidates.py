"""Squares that read as markers, and which of several at one place is the marker."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.detect.named import Named
from tagmetry.detect.places import first_per_place
from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Candidates(Named):
    """n squares that read as markers, a row each.

    Attributes:
        sharp_outline: How clearly the image steps across their sides, within a pixel, 0 to 1, (n,).
    """

    sharp_outline: Array

    @classmethod
    def none(cls) -> Self:
        """Return no candidates."""
        none, zero = np.zeros(0, dtype=np.int64), np.zeros(0)
        return cls(none, none, none > 0, np.zeros((0, 4, 2)), none, zero, zero)

    def best_per_place(self) -> Self:
        """Return the best reading of each place, by family and id, then from left to right.

        Squares a few pixels off, or inside a wide border, read as well as the right one; the image
        steps across the right one's sides only.
        """
        if len(self) < 2:
            return self
        best_first = self.at(np.lexsort((-self.confidence * self.sharp_outline, self.hamming)))
        kept = best_first.at(first_per_place(best_first.corners_px))
        x, y = kept.corners_px.mean(axis=1).T
        return kept.at(np.lexsort((y, x, kept.ids, kept.families)))

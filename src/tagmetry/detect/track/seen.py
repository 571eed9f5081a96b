"""The markers that an image shows, before their corners are measured exactly."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.detect.candidates import Candidates
from tagmetry.detect.named import Named
from tagmetry.detect.places import in_places
from tagmetry.detect.track.sight import Sights
from tagmetry.geometry.arrays import BoolArray, IntArray


@dataclass(frozen=True, eq=False)
class Seen(Named):
    """n markers, a row each.

    Attributes:
        rows: Which of the followed markers each is, -1 for one that was not followed, shape (n,).
    """

    rows: IntArray

    @classmethod
    def nothing(cls) -> Self:
        """Return no markers."""
        none = np.zeros(0, dtype=np.int64)
        return cls(none, none, none > 0, np.zeros((0, 4, 2)), none, np.zeros(0), none)

    @classmethod
    def by_sight(
        cls,
        sights: Sights,
        family_place: int,
        rows: IntArray,
        is_inverted: BoolArray,
        there: BoolArray,
    ) -> Self:
        """Return those followed markers of one family that are there.

        Args:
            sights: How they look, n.
            family_place: Of their family in the detector's list.
            rows: Which of the followed markers they are, shape (n,).
            is_inverted: White on black, shape (n,).
            there: Whether each is there, shape (n,).
        """
        return cls(
            np.full(int(there.sum()), family_place),
            sights.ids[there],
            is_inverted[there],
            sights.corners_px[there],
            sights.hamming[there],
            sights.confidence[there],
            rows[there],
        )

    @classmethod
    def by_search(cls, found: Candidates, rows: IntArray) -> Self:
        """Return markers that were searched for; `rows` as above."""
        what = found.families, found.ids, found.is_inverted
        return cls(*what, found.corners_px, found.hamming, found.confidence, rows)

    def others(self, count: int) -> BoolArray:
        """Say which of so many followed markers are not among these, shape (count,)."""
        others = np.ones(count, dtype=bool)
        others[self.rows[self.rows >= 0]] = False
        return others

    def one_per_place(self) -> Self:
        """Return the markers without those whose family and id stand earlier in one place."""
        kept = np.ones(len(self), dtype=bool)
        for i in np.flatnonzero(self.count_of_each > 1):
            same = kept & (self.families == self.families[i]) & (self.ids == self.ids[i])
            same[i:] = False
            kept[i] = not in_places(self.corners_px[i : i + 1], self.corners_px[same])[0]
        return self if kept.all() else self.at(kept)

"""The markers that an image shows, before their corners are measured exactly."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.detect.choose import Candidate
from tagmetry.detect.places import in_places
from tagmetry.detect.track.sight import Sights
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray
from tagmetry.markers import MarkerFamily

_MOST_IDS = 2**32  # of a family


@dataclass(frozen=True, eq=False)
class Seen:
    """n markers, a row each.

    Attributes:
        rows: Which of the followed markers each is, -1 for one that was not followed, shape (n,).
        families: Places of their families in the detector's list, shape (n,).
        ids: Shape (n,).
        is_inverted: White on black, shape (n,).
        corners_px: Good to about a pixel, shape (n, 4, 2).
        hamming: Wrong bits, shape (n,).
        confidence: 0 to 1, shape (n,).
    """

    rows: IntArray
    families: IntArray
    ids: IntArray
    is_inverted: BoolArray
    corners_px: Array
    hamming: IntArray
    confidence: Array

    def __len__(self) -> int:
        """The number of markers."""
        return len(self.ids)

    @classmethod
    def nothing(cls) -> Self:
        """Return no markers."""
        none = np.zeros(0, dtype=np.int64)
        return cls(none, none, none, none > 0, np.zeros((0, 4, 2)), none, np.zeros(0))

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
            rows[there],
            np.full(int(there.sum()), family_place),
            sights.ids[there],
            is_inverted[there],
            sights.corners_px[there],
            sights.hamming[there],
            sights.confidence[there],
        )

    @classmethod
    def by_search(
        cls, candidates: Sequence[Candidate], rows: IntArray, families: Sequence[MarkerFamily]
    ) -> Self:
        """Return markers that were searched for; `rows` as above."""
        if not candidates:
            return cls.nothing()
        matches = [one.match for one in candidates]
        return cls(
            rows,
            np.array([families.index(match.family) for match in matches]),
            np.array([match.id for match in matches]),
            np.array([one.is_inverted for one in candidates]),
            np.stack([one.corners_px for one in candidates]),
            np.array([match.hamming for match in matches]),
            np.array([match.confidence for match in matches]),
        )

    def at(self, rows: IntArray | BoolArray) -> Self:
        """Return some of the markers."""
        return type(self)(*(values[rows] for values in vars(self).values()))

    def and_also(self, others: Self) -> Self:
        """Return these markers and others."""
        if not len(others):
            return self
        pairs = zip(vars(self).values(), vars(others).values(), strict=True)
        return type(self)(*(np.concatenate(pair) for pair in pairs))

    def count_of_each(self) -> IntArray:
        """Return how often the family and id of each are there, shape (n,)."""
        keys = self.families * _MOST_IDS + self.ids
        in_order = np.sort(keys)
        if not (in_order[1:] == in_order[:-1]).any():
            return np.ones(len(keys), dtype=np.int64)
        _, which, counts = np.unique(keys, return_inverse=True, return_counts=True)
        return np.asarray(counts[which])

    def one_per_place(self) -> Self:
        """Return the markers without those whose family and id stand earlier in one place."""
        kept = np.ones(len(self), dtype=bool)
        for i in np.flatnonzero(self.count_of_each() > 1):
            same = kept & (self.families == self.families[i]) & (self.ids == self.ids[i])
            same[i:] = False
            kept[i] = not in_places(self.corners_px[i : i + 1], self.corners_px[same])[0]
        return self.at(kept)

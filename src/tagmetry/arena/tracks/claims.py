"""Sightings that do not fit their tracks: wrong ones, or robots that were carried or swapped.

One such sighting is passed over. Where several in a row agree among themselves, as a track of their
own, that track takes the place of the old one.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.arena.sighting import Sightings
from tagmetry.arena.tracks.motion import Motion
from tagmetry.arena.tracks.table import TrackTable
from tagmetry.geometry.arrays import BoolArray, IntArray


@dataclass(frozen=True, eq=False)
class Claims:
    """Tracks beside the tracks, a row for each robot.

    Attributes:
        table: The sightings that were passed over, as tracks.
        counts: How many of them agree, one after another, shape (n,).
    """

    table: TrackTable
    counts: IntArray

    @classmethod
    def none(cls, count: int) -> Self:
        """Return no claims for n robots."""
        return cls(TrackTable.empty(count), np.zeros(count, dtype=np.int64))

    def moved(self, motion: Motion, step_s: float) -> "Claims":
        """Return the claims some seconds later."""
        if not self.counts.any():
            return self
        return Claims(self.table.moved(motion, step_s), self.counts)

    def without(self, rows: IntArray | BoolArray) -> "Claims":
        """Return the claims but those of some robots."""
        counts = self.counts.copy()
        counts[rows] = 0
        return Claims(self.table, counts)

    def with_more(self, seen: Sightings, time_s: float, gate: float) -> "Claims":
        """Return the claims after sightings that did not fit, one of a robot at most.

        Args:
            seen: The sightings.
            time_s: When.
            gate: Squared Mahalanobis distance up to which two of them agree.
        """
        near = self.table.distances2(seen.rows, seen.places, seen.noise) <= gate
        agrees = near & (self.counts[seen.rows] > 0)
        table, counts = self.table, self.counts.copy()
        old, new = seen.at(agrees), seen.at(~agrees)
        table = table.updated(old.rows, old.places, old.noise, old.common, time_s)
        table = table.begun(new.rows, new.places, new.noise, new.common, time_s)
        counts[seen.rows[agrees]] += 1
        counts[seen.rows[~agrees]] = 1
        return Claims(table, counts)

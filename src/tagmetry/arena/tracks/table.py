"""The tracks of an arena's robots, a row each."""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from tagmetry.arena.tracks.filter import distances2, update
from tagmetry.arena.tracks.motion import Motion
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import BoolArray, IntArray

FASTEST_MPS, FASTEST_RADPS = 1.0, 4.0  # standard deviations of what was seen once


@dataclass(frozen=True, eq=False)
class TrackTable:
    """What is believed of n robots at one moment.

    Attributes:
        means: (x, y, heading, speed, turn rate), shape (n, 5).
        covariances: From the noise alone, shape (n, 5, 5).
        common: Of (x, y, heading), what no filter makes smaller, shape (n, 3, 3).
        seen_s: When each was seen last; NaN where there is no track, shape (n,).
    """

    means: Array
    covariances: Array
    common: Array
    seen_s: Array

    @classmethod
    def empty(cls, count: int) -> Self:
        """Return a table of robots that were never seen."""
        return cls(
            np.zeros((count, 5)),
            np.broadcast_to(np.eye(5), (count, 5, 5)).copy(),
            np.zeros((count, 3, 3)),
            np.full(count, np.nan),
        )

    @property
    def has_track(self) -> BoolArray:
        """Which robots have one, shape (n,)."""
        return np.asarray(np.isfinite(self.seen_s))

    def moved(self, motion: Motion, step_s: float) -> "TrackTable":
        """Return the table some seconds later."""
        means, covariances = motion.moved(self.means, self.covariances, step_s)
        return replace(self, means=means, covariances=covariances)

    def dropped(self, rows: BoolArray) -> "TrackTable":
        """Return the table without some of its tracks."""
        return replace(self, seen_s=np.where(rows, np.nan, self.seen_s))

    def begun(
        self, rows: IntArray, places: Array, noise: Array, common: Array, time_s: float
    ) -> "TrackTable":
        """Return the table with robots that are seen for the first time, or anew."""
        means, covariances = self.means.copy(), self.covariances.copy()
        means[rows], covariances[rows] = 0.0, 0.0
        means[rows, :3] = places
        covariances[rows, :3, :3] = noise
        covariances[rows, 3, 3], covariances[rows, 4, 4] = FASTEST_MPS**2, FASTEST_RADPS**2
        return self._with(rows, means, covariances, common, time_s)

    def updated(
        self, rows: IntArray, places: Array, noise: Array, common: Array, time_s: float
    ) -> "TrackTable":
        """Return the table after robots were seen (Kalman's update, in Joseph's form)."""
        means, covariances = self.means.copy(), self.covariances.copy()
        update(means, covariances, rows, places, noise)
        return self._with(rows, means, covariances, common, time_s)

    def distances2(self, rows: IntArray, places: Array, noise: Array) -> Array:
        """Return squared Mahalanobis distances of sightings from their tracks, shape (m,)."""
        return distances2(self.means, self.covariances, rows, places, noise)

    def _with(
        self, rows: IntArray, means: Array, covariances: Array, common: Array, time_s: float
    ) -> "TrackTable":
        all_common, seen_s = self.common.copy(), self.seen_s.copy()
        all_common[rows], seen_s[rows] = common, time_s
        return TrackTable(means, covariances, all_common, seen_s)


def innovations(means: Array, places: Array) -> Array:
    """Return seen minus expected, the heading's the short way round, shape (m, 3)."""
    off = places - means[:, :3]
    off[:, 2] = wrap_angle_rad(off[:, 2])
    return np.asarray(off)

"""Which squares are markers?"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from tagmetry.detect.candidates import Candidates
from tagmetry.detect.reading.decode import Reading, Readings, has_border, has_outline
from tagmetry.detect.reading.nearest import Matches, nearest, nearest_of_each
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray
from tagmetry.markers import MarkerFamily

_LEAST_CONFIDENCE = 0.3
_WEAK_CHANCE = 1e-4  # families that random bits pass for more often must be read clearly
_LEAST_OF_WEAK = 0.85
_MANY_BITS = 1000  # more than any code has
_TURNED = np.array([[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2]])


@dataclass(frozen=True)
class Rules:
    """What passes for a marker.

    Attributes:
        forgive_bits: Wrong bits to forgive; each family's own number when None.
        inverted: White on black is wanted as well.
    """

    forgive_bits: int | None
    inverted: bool

    def markers_among(
        self,
        corners_px: Array,
        is_bright: BoolArray,
        readings: Readings,
        families: Mapping[int, MarkerFamily],
    ) -> Candidates:
        """Return the markers that squares show, all at once.

        Args:
            corners_px: The squares, shape (n, 4, 2).
            is_bright: Whether each outline is that of a bright area, shape (n,).
            readings: How they read in the layout of the families.
            families: Families of one layout, by their places in the detector's list.
        """
        is_inverted = is_bright != next(iter(families.values())).layout.white_border
        rows = self._possible(readings, is_inverted)
        if not len(rows):
            return Candidates.none()
        near = [
            nearest_of_each(readings, rows, one, self._forgiven(one)) for one in families.values()
        ]
        best, passes = self._best_of_each(near)
        which, found, k = best[passes], rows[passes], np.flatnonzero(passes)
        quarters = np.stack([one.quarters for one in near])[which, k]
        return Candidates(
            np.array(list(families))[which],
            np.stack([one.ids for one in near])[which, k],
            readings.measures[found, 1] < 0,
            corners_px[found[:, None], _TURNED[quarters]],
            np.stack([one.hammings for one in near])[which, k],
            np.stack([one.confidences for one in near])[which, k],
            readings.measures[found, 3],
        )

    def why_not(
        self, is_bright: bool, reading: Reading | None, families: Sequence[MarkerFamily]
    ) -> str | None:
        """Return the reason why a square shows no marker; None when it shows one.

        Args:
            is_bright: Whether its outline is that of a bright area.
            reading: How it reads in the layout of the families.
            families: Families of one layout.
        """
        if reading is None:
            return "black and white cannot be told apart"
        reason = self._not_a_marker(reading, is_bright != families[0].layout.white_border)
        if reason is not None:
            return reason
        matches = [nearest(reading, one) for one in families]
        match = min(matches, key=lambda m: (m.hamming - self._forgiven(m.family), m.hamming))
        if match.hamming > self._forgiven(match.family):
            return (
                f"nearest code is {match.family.name} id {match.id} with {match.hamming} wrong "
                f"bits, {self._forgiven(match.family)} are forgiven"
            )
        if match.confidence < _least_confidence(match.family):
            return f"{match.family.name} id {match.id} is too unclear ({match.confidence:.2f})"
        return None

    def _best_of_each(self, near: Sequence[Matches]) -> tuple[IntArray, BoolArray]:
        """Return which of some families' matches is the best, and whether it passes, (m,) each."""
        over = np.stack([one.hammings - self._forgiven(one.family) for one in near])
        clear = np.stack([one.confidences >= _least_confidence(one.family) for one in near])
        best = (over + np.stack([one.hammings for one in near]) / _MANY_BITS).argmin(axis=0)
        at = best, np.arange(over.shape[1])
        return best, np.asarray((over[at] <= 0) & clear[at])

    def _possible(self, readings: Readings, is_inverted: BoolArray) -> IntArray:
        """Return which squares may be markers, whatever their bits say."""
        rows, contrast = readings.bordered, readings.measures[readings.bordered, 1]
        as_found = is_inverted[rows] == (contrast < 0)
        wanted = as_found & ((contrast >= 0) | self.inverted)
        return np.asarray(rows[wanted & readings.outlined[rows]])

    def _not_a_marker(self, reading: Reading, is_inverted: bool) -> str | None:
        """Return why a square is no marker at all, whatever its bits say; None when it may be."""
        if not has_border(reading):
            return f"only {reading.border_share:.0%} of its border reads as printed"
        if not has_outline(reading):
            return "the image does not change across its sides; a wider border around it?"
        if is_inverted != (reading.contrast < 0):
            return "the inside of a border, not a border"
        if reading.contrast < 0 and not self.inverted:
            return "white on black; look for inverted markers to accept it"
        return None

    def _forgiven(self, family: MarkerFamily) -> int:
        return family.forgiven_bits if self.forgive_bits is None else self.forgive_bits


@lru_cache
def _least_confidence(family: MarkerFamily) -> float:
    weak = family.chance_of_random_match(wrong_bits=0) > _WEAK_CHANCE
    return _LEAST_OF_WEAK if weak else _LEAST_CONFIDENCE

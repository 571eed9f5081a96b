"""Which squares are markers, and which of several squares at one place is the marker."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.detect.detection import Detection, Rejection
from tagmetry.detect.places import first_per_place
from tagmetry.detect.reading.decode import Reading, Readings, has_border, has_outline
from tagmetry.detect.reading.nearest import Match, Matches, nearest, nearest_of_each
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray
from tagmetry.markers import MarkerFamily

_LEAST_CONFIDENCE = 0.3
_WEAK_CHANCE = 1e-4  # families that random bits pass for more often must be read clearly
_LEAST_OF_WEAK = 0.85
_MANY_BITS = 1000  # more than any code has
_TURNED = np.array([[0, 1, 2, 3], [1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2]])


@dataclass(frozen=True, eq=False)
class Candidate:
    """A square that reads as a marker.

    Attributes:
        corners_px: Clockwise from the marker's own top left, shape (4, 2).
        match: The marker.
        is_inverted: It is printed white on black.
        sharp_outline: How clearly the image steps across its sides, within a pixel, 0 to 1.
    """

    corners_px: Array
    match: Match
    is_inverted: bool
    sharp_outline: float

    @property
    def rank(self) -> tuple[int, float]:
        """Sorts better readings first.

        Squares a few pixels off, or inside a wide border, read as well as the right one; the image
        steps across the right one's sides only.
        """
        return self.match.hamming, -self.match.confidence * self.sharp_outline


@dataclass(frozen=True)
class Rules:
    """What passes for a marker.

    Attributes:
        forgive_bits: Wrong bits to forgive; each family's own number when None.
        inverted: White on black is wanted as well.
    """

    forgive_bits: int | None
    inverted: bool

    def judge(
        self,
        corners_px: Array,
        is_bright: bool,
        reading: Reading | None,
        families: Sequence[MarkerFamily],
    ) -> Candidate | str:
        """Return the marker that a square shows, or the reason why it shows none.

        Args:
            corners_px: The square, shape (4, 2).
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
        return _candidate(corners_px, match, reading.contrast, reading.sharp_outline)

    def markers_among(
        self,
        corners_px: Array,
        is_bright: BoolArray,
        readings: Readings,
        families: Sequence[MarkerFamily],
    ) -> list[Candidate]:
        """Return the markers that squares show: those of which `judge` says so, all at once.

        Args:
            corners_px: The squares, shape (n, 4, 2).
            is_bright: Whether each outline is that of a bright area, shape (n,).
            readings: How they read in the layout of the families.
            families: Families of one layout.
        """
        rows = self._possible(readings, is_bright != families[0].layout.white_border)
        near = [nearest_of_each(readings, rows, one, self._forgiven(one)) for one in families]
        best, passes = self._best_of_each(near)
        found = [(rows[k], near[best[k]][k]) for k in np.flatnonzero(passes).tolist()]
        contrasts, outlines = readings.measures[:, 1].tolist(), readings.measures[:, 3].tolist()
        return [
            _candidate(corners_px[row], match, contrasts[row], outlines[row])
            for row, match in found
        ]

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


def _candidate(corners_px: Array, match: Match, contrast: float, sharp_outline: float) -> Candidate:
    return Candidate(corners_px[_TURNED[match.quarters]], match, contrast < 0, sharp_outline)


def _least_confidence(family: MarkerFamily) -> float:
    weak = family.chance_of_random_match(wrong_bits=0) > _WEAK_CHANCE
    return _LEAST_OF_WEAK if weak else _LEAST_CONFIDENCE


def best_per_place(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Return the best reading of each place, in an order that does not depend on chance."""
    best_first = sorted(candidates, key=lambda c: c.rank)
    corners_px = np.array([c.corners_px for c in best_first]).reshape(-1, 4, 2)
    centres_px = corners_px.mean(axis=1)
    first = np.flatnonzero(first_per_place(corners_px)).tolist()
    names = [(best_first[i].match.family.name, best_first[i].match.id) for i in first]
    order = sorted(zip(names, centres_px[first].tolist(), first, strict=True))
    return [best_first[i] for _, _, i in order]


def distinct_rejections(
    rejections: Sequence[Rejection], detections: Sequence[Detection]
) -> tuple[Rejection, ...]:
    """Return one rejection per place, none where a marker was found."""
    squares = [d.corners_px for d in detections] + [r.corners_px for r in rejections]
    found = len(detections)
    return tuple(rejections[i - found] for i in _first_per_place(squares) if i >= found)


def with_duplicates_marked(detections: Sequence[Detection]) -> tuple[Detection, ...]:
    """Flag markers whose family and id stand in the image more than once."""
    keys = [(detection.family, detection.id) for detection in detections]
    return tuple(
        replace(detection, is_duplicate=True) if keys.count(key) > 1 else detection
        for key, detection in zip(keys, detections, strict=True)
    )


def _first_per_place(squares_px: Sequence[Array]) -> list[int]:
    """Return the indices of those squares (4, 2) that no earlier one stands in the place of."""
    if not squares_px:
        return []
    return [int(i) for i in np.flatnonzero(first_per_place(np.stack(squares_px)))]

"""Is the marker there? Its square is moved onto the edges, and its cells are read.

Where motion blurs edges until they are nowhere steep, the prediction may be the better place:
the one of the two is taken that looks more like the marker.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Self

import numpy as np

from tagmetry.detect.reading.sample import cell_means, side_lengths, steps_across
from tagmetry.detect.track.cells import expected, places
from tagmetry.detect.track.nudge import nudged
from tagmetry.geometry import Array, square_to_quad
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray
from tagmetry.markers import MarkerFamily

_TAP_CELLS = 0.17  # how far from a cell's centre its four taps are
_REACH_CELLS = 1.5  # farther away there are other edges like those of the border
_LEAST_REACH_PX = 2.0
_FINE_CELLS = 0.5  # how far edges are looked for once more
_LEAST_FINE_PX = 1.5
_CLEAR = 0.9  # correlation below which the place that was predicted is tried as well
_LEAST_CONTRAST = 8.0  # grey values between black and white
_PLAIN_ERRORS = 0.2  # share of the border's cells that may be wrong, and of the quiet zone's
_LEAST_CONFIDENCE = 0.3
_EDGE_CELLS = 0.3  # how far inside and outside a side the image must differ
_LEAST_STEP = 0.35  # share of the clearest side's step that all must have


@dataclass(frozen=True, eq=False)
class Sights:
    """How the places of n markers of one family look; k places each, the bits first.

    Attributes:
        family: The family.
        ids: Which marker is expected, shape (n,).
        corners_px: The squares that were read, shape (n, 4, 2).
        margins: (value - middle) / half the contrast: about -1 is black, +1 white, shape (n, k).
        expected: What should be seen, -1 or +1, shape (n, k).
        contrast: White minus black, grey values, or black minus white where that is expected;
            negative where the colours are the other way about, shape (n,).
        correlation: Of what is seen with what is expected, even light aside, -1 to 1, shape (n,).
        steps: By how much the image changes across each side, as it should, grey values, (n, 4).
    """

    family: MarkerFamily
    ids: IntArray
    corners_px: Array
    margins: Array
    expected: Array
    contrast: Array
    correlation: Array
    steps: Array

    @property
    def bits(self) -> Array:
        """The margins of the bits, shape (n, bits)."""
        return self.margins[:, : self.family.layout.bit_count]

    @property
    def hamming(self) -> IntArray:
        """How many bits read other than expected, shape (n,)."""
        count = self.family.layout.bit_count
        return np.asarray((self._agreement[:, :count] <= 0).sum(axis=1))

    @property
    def confidence(self) -> Array:
        """Mean clearness of bits and border, those read wrong counting against, 0 to 1, (n,)."""
        count = self.margins.shape[1] - places(self.family.layout).quiet
        clear = np.clip(self._agreement[:, :count], -1, 1).mean(axis=1)
        return np.asarray(np.clip(clear, 0, 1))

    @property
    def is_framed(self) -> BoolArray:
        """Whether a border of enough contrast is there and ends at all four sides, shape (n,)."""
        layout = self.family.layout
        right = self._agreement[:, layout.bit_count :] > 0
        count = right.shape[1] - places(layout).quiet
        framed = right[:, :count].mean(axis=1) >= 1 - _PLAIN_ERRORS
        if count < right.shape[1]:
            framed &= right[:, count:].mean(axis=1) >= 1 - _PLAIN_ERRORS
        return np.asarray(framed & self.has_sides & (self.contrast >= _LEAST_CONTRAST))

    @property
    def has_sides(self) -> BoolArray:
        """Whether the image changes about as much across all four sides, shape (n,)."""
        return np.asarray(self.steps.min(axis=1) >= _LEAST_STEP * self.steps.max(axis=1))

    def reads_as_expected(self, forgiven_bits: int) -> BoolArray:
        """Say which markers are there by all their cells, shape (n,)."""
        few = self.hamming <= min(forgiven_bits, self.family.correction_bits)
        return np.asarray(self.is_framed & few & (self.confidence >= _LEAST_CONFIDENCE))

    def replaced(self, which: IntArray, others: Self) -> Self:
        """Return these with those at `which` (m,) replaced by m others, where these look better."""
        better = others.correlation > self.correlation[which]
        changed = {}
        for name in ("corners_px", "margins", "contrast", "correlation", "steps"):
            changed[name] = getattr(self, name).copy()
            changed[name][which[better]] = getattr(others, name)[better]
        return replace(self, **changed)

    @classmethod
    def joined(cls, parts: Sequence[Self]) -> Self:
        """Return markers of one family that were looked at in parts as if it were one."""
        names = [one.name for one in fields(cls) if one.name != "family"]
        columns = [np.concatenate([getattr(part, name) for part in parts]) for name in names]
        return cls(parts[0].family, *columns)

    @property
    def _agreement(self) -> Array:
        return self.margins * self.expected


def look(
    grey: GreyPixels,
    family: MarkerFamily,
    ids: IntArray,
    corners_px: Array,
    deviation_px: Array,
    is_inverted: BoolArray,
) -> Sights:
    """Return what is seen where markers of one family are expected.

    Args:
        grey: 8-bit image.
        family: Their family.
        ids: Which they are, shape (n,).
        corners_px: Where they are expected, shape (n, 4, 2).
        deviation_px: How far they may be from there, standard deviation, shape (n,).
        is_inverted: White on black, shape (n,).
    """
    sign = np.where(is_inverted != family.layout.white_border, -1.0, 1.0)
    first_px = np.ascontiguousarray(corners_px)
    moved_px = _on_edges(grey, first_px, deviation_px, sign, family.layout.side_cells)
    sights = _read(grey, family, ids, moved_px, sign, is_inverted)
    doubtful = np.flatnonzero(sights.correlation < _CLEAR)
    if not len(doubtful):
        return sights
    at = ids[doubtful], first_px[doubtful], sign[doubtful], is_inverted[doubtful]
    return sights.replaced(doubtful, _read(grey, family, *at))


def _on_edges(
    grey: GreyPixels, corners_px: Array, deviation_px: Array, sign: Array, side_cells: int
) -> Array:
    """Return squares moved onto the edges close by: from afar at first coarsely, then finely."""
    reach_px = nudge_reach_px(corners_px, deviation_px, side_cells)
    near_px = nudged(grey, corners_px, reach_px, sign)
    fine_px = np.maximum(_FINE_CELLS * _cell_px(near_px, side_cells), _LEAST_FINE_PX)
    again = reach_px > fine_px
    if again.any():
        near_px[again] = nudged(grey, near_px[again], fine_px[again], sign[again])
    return near_px


def _read(
    grey: GreyPixels,
    family: MarkerFamily,
    ids: IntArray,
    corners_px: Array,
    sign: Array,
    is_inverted: BoolArray,
) -> Sights:
    """Return what squares show."""
    seen, cells = places(family.layout), family.layout.side_cells
    values = cell_means(grey, square_to_quad(corners_px), seen.at, _TAP_CELLS / cells)
    pairs = [expected(family, marker_id) for marker_id in ids.tolist()]
    white, by_value = np.stack([one for one, _ in pairs]), np.stack([one for _, one in pairs])
    half = (values * by_value).sum(axis=1)
    rest = values - half[:, None] * white
    middle = (rest @ seen.light) @ seen.light.T
    uneven = values - (values @ seen.light) @ seen.light.T
    steps = steps_across(grey, corners_px, _EDGE_CELLS * _cell_px(corners_px, cells))
    with np.errstate(divide="ignore", invalid="ignore"):
        margins = np.nan_to_num((values - middle) / half[:, None])
        correlation = half / np.linalg.norm(by_value, axis=1) / np.linalg.norm(uneven, axis=1)
    is_other = np.where(is_inverted, -1.0, 1.0)
    return Sights(
        family,
        ids,
        corners_px,
        margins,
        white,
        2 * is_other * half,
        np.nan_to_num(is_other * correlation),
        (sign[:, None] * steps).reshape(len(ids), 4, -1).mean(axis=2),
    )


def nudge_reach_px(corners_px: Array, deviation_px: Array, side_cells: int) -> Array:
    """Return how far from predictions edges are looked for, shape (n,)."""
    most_px = np.maximum(_REACH_CELLS * _cell_px(corners_px, side_cells), _LEAST_REACH_PX)
    return np.asarray(np.clip(1 + 3 * deviation_px, _LEAST_REACH_PX, most_px))


def _cell_px(corners_px: Array, side_cells: int) -> Array:
    return np.asarray(side_lengths(corners_px).mean(axis=1) / side_cells)

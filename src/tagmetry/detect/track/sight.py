"""Is the marker there? What is seen where it is expected says so."""

from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np

from tagmetry.detect.places import side_lengths
from tagmetry.detect.track.cells import expected, places
from tagmetry.detect.track.seeing import Asked, Shown, see_each
from tagmetry.detect.workers import at_once, shares
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray
from tagmetry.markers import MarkerFamily

_REACH_CELLS = 1.5  # farther away there are other edges like those of the border
_LEAST_REACH_PX = 2.0
_LEAST_CONTRAST = 8.0  # grey values between black and white
_PLAIN_ERRORS = 0.2  # share of the border's cells that may be wrong, and of the quiet zone's
_LEAST_CONFIDENCE = 0.3
_LEAST_STEP = 0.35  # share of the clearest side's step that all must have
_LEAST_SHARE = 24  # markers, that waking a thread be worth it


@dataclass(frozen=True, eq=False)
class Sights:
    """How the places of n markers of one family look; k places each, the bits first.

    Attributes:
        family: The family.
        ids: Which marker is expected, shape (n,).
        corners_px: The squares that were read, shape (n, 4, 2).
        margins: (value - middle) / half the contrast: about -1 is black, +1 white, shape (n, k).
        measures: See the properties, shape (n, 6).
        steps: By how much the image changes across each side, as it should, grey values, (n, 4).
    """

    family: MarkerFamily
    ids: IntArray
    corners_px: Array
    margins: Array
    measures: Array
    steps: Array

    @property
    def contrast(self) -> Array:
        """White minus black, grey values, or black minus white where that is expected, (n,)."""
        return self.measures[:, 0]

    @property
    def correlation(self) -> Array:
        """Of what is seen with what is expected, even light aside, -1 to 1, shape (n,)."""
        return self.measures[:, 1]

    @property
    def hamming(self) -> IntArray:
        """How many bits read other than expected, shape (n,)."""
        return self.measures[:, 2].astype(np.int64)

    @property
    def confidence(self) -> Array:
        """Mean clearness of bits and border, those read wrong counting against, 0 to 1, (n,)."""
        return self.measures[:, 3]

    @property
    def is_framed(self) -> BoolArray:
        """Whether a border of enough contrast is there and ends at all four sides, shape (n,)."""
        framed = (self.measures[:, 4:] >= 1 - _PLAIN_ERRORS).all(axis=1)
        return np.asarray(framed & self.has_sides & (self.contrast >= _LEAST_CONTRAST))

    @property
    def has_sides(self) -> BoolArray:
        """Whether the image changes about as much across all four sides, shape (n,)."""
        return np.asarray(self.steps.min(axis=1) >= _LEAST_STEP * self.steps.max(axis=1))

    def reads_as_expected(self, forgiven_bits: int) -> BoolArray:
        """Say which markers are there by all their cells, shape (n,)."""
        few = self.measures[:, 2] <= min(forgiven_bits, self.family.correction_bits)
        return np.asarray(self.is_framed & few & (self.confidence >= _LEAST_CONFIDENCE))

    def expected(self, row: int) -> Array:
        """Return what should be seen of a marker, -1 or +1, shape (k,)."""
        return expected(self.family, int(self.ids[row]))


def look(
    grey: GreyPixels,
    family: MarkerFamily,
    ids: IntArray,
    corners_px: Array,
    deviation_px: Array,
    is_inverted: BoolArray,
) -> Sights:
    """Return what is seen where markers of one family are expected; threads share in it.

    Args:
        grey: 8-bit image.
        family: Their family.
        ids: Which they are, shape (n,).
        corners_px: Where they are expected, shape (n, 4, 2).
        deviation_px: How far they may be from there, standard deviation, shape (n,).
        is_inverted: White on black, shape (n,).
    """
    at, layout = places(family.layout), family.layout
    sign = np.where(is_inverted != layout.white_border, -1.0, 1.0)
    reach_px = nudge_reach_px(corners_px, deviation_px, layout.side_cells)
    count, k = len(ids), len(at.light)
    shown = Shown(
        np.empty((count, 4, 2)), np.empty((count, k)), np.empty((count, 6)), np.empty((count, 4))
    )

    def look_at(some: slice) -> None:
        codes, at_px = family.codes[ids[some]], np.ascontiguousarray(corners_px[some])
        asked = Asked(codes, at_px, reach_px[some], sign[some], is_inverted[some])
        see_each(grey, asked, at, Shown(*(one[some] for one in shown)))

    at_once([partial(look_at, some) for some in shares(count, _LEAST_SHARE, cv2.getNumThreads())])
    return Sights(family, ids, *shown)


def nudge_reach_px(corners_px: Array, deviation_px: Array, side_cells: int) -> Array:
    """Return how far from predictions edges are looked for, shape (n,)."""
    cell_px = side_lengths(corners_px).mean(axis=1) / side_cells
    most_px = np.maximum(_REACH_CELLS * cell_px, _LEAST_REACH_PX)
    return np.asarray(np.clip(1 + 3 * deviation_px, _LEAST_REACH_PX, most_px))

"""Which marker is it? Bits are read at cell centres against local black and white.

Black is a plane fitted to the border's cells, white a plane fitted just outside the border; where a
white border lies within a black ring, to the cells of these. The threshold lies midway, so light
that falls off across the marker does no harm. Each bit is sharpened
against the cells beside it: blur mixes neighbours, and single cells would drown in theirs first.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from tagmetry.detect.reading.sample import cell_means, taps_of
from tagmetry.detect.reading.spots import BORDER_ERRORS, LEAST_OUTLINE, Spots, read_each
from tagmetry.geometry import Array, square_to_quad
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray
from tagmetry.markers import Layout
from tagmetry.markers.packed import Words, packed

_OUTSIDE_CELLS = 0.35  # how far outside the border white is looked for
_LEAST_WHITE = 0.1  # share of the bits; pictures have some white in them
_TAP_CELLS = 0.17  # how far from a cell's centre its four taps are


@dataclass(frozen=True)
class Reading:
    """How one quadrilateral reads in one layout; of one without a border no bits are read.

    Attributes:
        margins: Of each bit, (value - threshold) / half the contrast, shape (bits,); white is
            positive.
        words: Which of them are white, as bits.
        border_share: Share of the frame's cells (border, and ring around it) that read as printed.
        contrast: White minus black, grey values; negative where the marker is inverted.
        border_margin: Mean clearness of the frame's cells.
        sharp_outline: How clearly the image steps across the sides, 0 to 1; 1 when all of the
            contrast lies within a pixel of them.
        outline: The same within a good part of a cell, where it is not clear within a pixel.
    """

    margins: Array
    words: Words
    border_share: float
    contrast: float
    border_margin: float
    sharp_outline: float
    outline: float


@dataclass(frozen=True, eq=False)
class Readings:
    """How n quadrilaterals read; None where black and white cannot be told apart.

    Attributes:
        margins: Those of each, shape (n, bits).
        words: Those of each, shape (n, words).
        measures: Border share, contrast, border margin, sharp outline, outline, shape (n, 5).
    """

    margins: Array
    words: Words
    measures: Array

    def __len__(self) -> int:
        return len(self.margins)

    def __getitem__(self, i: int) -> Reading | None:
        measures = self.measures[i].tolist()
        return None if np.isnan(measures[1]) else Reading(self.margins[i], self.words[i], *measures)

    def __iter__(self) -> Iterator[Reading | None]:
        return (self[i] for i in range(len(self)))

    @property
    def bordered(self) -> IntArray:
        """Which of them have a border, so that their bits were read, shape (k,)."""
        return np.asarray(np.flatnonzero(self.measures[:, 0] >= 1 - BORDER_ERRORS))

    @property
    def outlined(self) -> BoolArray:
        """Whether `has_outline` says so of each, shape (n,)."""
        return np.asarray(self.measures[:, 3:].max(axis=1) >= LEAST_OUTLINE)

    @property
    def pictured(self) -> BoolArray:
        """Which of them have a border with something printed inside: a blot is black all over."""
        pictured = (self.margins > 0).mean(axis=1) >= _LEAST_WHITE
        return np.asarray(pictured & (self.measures[:, 0] >= 1 - BORDER_ERRORS))


def read(grey: GreyPixels, corners_px: Array, layout: Layout) -> Readings:
    """Read quadrilaterals as markers of a layout.

    Args:
        grey: 8-bit image.
        corners_px: Shape (n, 4, 2), clockwise.
        layout: Where border and bits are.

    Returns:
        One reading each.
    """
    corners_px = np.ascontiguousarray(corners_px)
    count = len(corners_px)
    margins, measures = np.zeros((count, layout.bit_count)), np.zeros((count, 5))
    read_each(grey, corners_px, _spots(layout), margins, measures)
    return Readings(margins, packed(margins > 0), measures)


def free_colours(grey: GreyPixels, corners_px: Array, layout: Layout) -> BoolArray:
    """Return which of a layout's free cells are more white than black on a marker, shape (n,)."""
    H, reach = square_to_quad(corners_px)[None], _TAP_CELLS / layout.side_cells
    at = (layout.free_cells + 0.5) / layout.side_cells
    free, black, white = (cell_means(grey, H, where, reach) for where in (at, *_places(layout)))
    to_white = white.mean() - black.mean()
    return np.asarray(to_white * (free[0] - black.mean()) > to_white**2 / 2)


def has_border(reading: Reading) -> bool:
    """Say whether enough of the frame's cells read as they are printed."""
    return reading.border_share >= 1 - BORDER_ERRORS


def has_outline(reading: Reading) -> bool:
    """Say whether the image steps across the sides; it does not inside a wide border."""
    return max(reading.outline, reading.sharp_outline) >= LEAST_OUTLINE


@cache
def _spots(layout: Layout) -> Spots:
    """Return what the kernel looks at."""
    black, white = _places(layout)
    cells = np.concatenate([_frame(layout), layout.bit_centres])
    terms = _plane_terms(cells)
    return Spots(
        taps_of(np.concatenate([black, white]), _TAP_CELLS / layout.side_cells),
        taps_of(layout.bit_centres, _TAP_CELLS / layout.side_cells),
        _to_plane(black),
        _to_plane(white),
        terms,
        terms.mean(axis=0),
        _beside(layout),
        len(_frame(layout)),
        float(layout.side_cells),
        -1.0 if layout.white_border else 1.0,
    )


@cache
def _frame(layout: Layout) -> Array:
    """Return the centres of cells that are alike on all markers, (n, 2); black ones first."""
    cells = np.concatenate([layout.black_cells, layout.white_cells])
    return np.asarray((cells + 0.5) / layout.side_cells)


@cache
def _places(layout: Layout) -> tuple[Array, Array]:
    """Return where black and where white is looked for, (k, 2), units of the square's side."""
    black = _frame(layout)[: len(layout.black_cells)]
    white = _frame(layout)[len(layout.black_cells) :]
    return black, white if layout.white_border else _outside(layout)


@cache
def _outside(layout: Layout) -> Array:
    """Return places just outside the square, opposite the outermost border cells."""
    side = layout.side_cells
    along = (np.arange(side) + 0.5) / side
    near, far = np.full(side, -_OUTSIDE_CELLS / side), np.full(side, 1 + _OUTSIDE_CELLS / side)
    pairs = [(along, near), (along, far), (near, along), (far, along)]
    return np.concatenate([np.stack(pair, axis=1) for pair in pairs])


def _beside(layout: Layout) -> IntArray:
    """Return which cells, of frame and bits, touch each bit's sides, (bits, 4); else its own."""
    centres = np.concatenate([_frame(layout), layout.bit_centres]) * layout.side_cells
    apart = np.abs(layout.bit_centres[:, None] * layout.side_cells - centres).sum(axis=2)
    beside = np.tile(len(_frame(layout)) + np.arange(layout.bit_count)[:, None], (1, 4))
    for bit, near in enumerate(np.isclose(apart, 1.0)):
        beside[bit, : near.sum()] = np.flatnonzero(near)
    return np.asarray(beside)


def _plane_terms(at: Array) -> Array:
    """Return 1, u and v from the middle of each place (n, 2), shape (n, 3)."""
    return np.column_stack([np.ones(len(at)), at - 0.5])


def _to_plane(at: Array) -> Array:
    """Return what takes values at places (n, 2) to the plane through them, shape (n, 3)."""
    return np.ascontiguousarray(np.linalg.pinv(_plane_terms(at)).T, dtype=np.float64)

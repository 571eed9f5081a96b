"""How the cells of one marker are read: places, values, and black and white as planes."""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.reading.sample import cell_means
from tagmetry.geometry import Array, apply_homography, square_to_quad
from tagmetry.geometry.arrays import BoolArray, GreyPixels
from tagmetry.markers import Layout

_OUTSIDE_CELLS = 0.35  # how far outside a black border white is looked for
_TAP_CELLS = 0.17


@dataclass(frozen=True, eq=False)
class Sampled:
    """Where a marker is read, and what stands there.

    Attributes:
        black_px: Places that tell how dark black is, shape (n, 2).
        white_px: Places that tell how bright white is, shape (n, 2).
        bits_px: Middles of the bits' cells, shape (bits, 2).
        margins: Of each bit, (value - threshold) / half the contrast; white is positive, (bits,).
        levels: Black and white where each bit is, shape (bits, 2).
    """

    black_px: Array
    white_px: Array
    bits_px: Array
    margins: Array
    levels: Array

    @property
    def is_white(self) -> BoolArray:
        """How the bits read, shape (bits,)."""
        return np.asarray(self.margins > 0)


def sampled(grey: GreyPixels, corners_px: Array, layout: Layout) -> Sampled:
    """Return how a marker reads at corners (4, 2), clockwise from its own top left."""
    H = square_to_quad(corners_px)
    black_at, white_at = _places(layout)
    reach = _TAP_CELLS / layout.side_cells
    places = (black_at, white_at, layout.bit_centres)
    black, white, bits = (cell_means(grey, H[None], at, reach)[0] for at in places)
    levels = np.stack(
        [_plane(black_at, black, layout.bit_centres), _plane(white_at, white, layout.bit_centres)],
        axis=1,
    )
    half = np.maximum(np.abs(levels[:, 1] - levels[:, 0]) / 2, 1.0)
    margins = (bits - levels.mean(axis=1)) / half * np.sign(levels[:, 1] - levels[:, 0])
    black_px, white_px, bits_px = (apply_homography(H, at) for at in places)
    return Sampled(black_px, white_px, bits_px, margins, levels)


def _places(layout: Layout) -> tuple[Array, Array]:
    """Return where black and where white is looked for, (k, 2), with the side as the unit."""
    black = (layout.black_cells + 0.5) / layout.side_cells
    if layout.white_border:
        return black, (layout.white_cells + 0.5) / layout.side_cells
    along = (np.arange(layout.side_cells) + 0.5) / layout.side_cells
    beyond = _OUTSIDE_CELLS / layout.side_cells
    low, high = np.full_like(along, -beyond), np.full_like(along, 1 + beyond)
    pairs = [(along, low), (along, high), (low, along), (high, along)]
    return black, np.concatenate([np.stack(pair, axis=1) for pair in pairs])


def _plane(at: Array, values: Array, wanted: Array) -> Array:
    """Return a plane fitted to values (k,) at places (k, 2), at other places (m, 2)."""
    solution = np.linalg.lstsq(np.c_[np.ones(len(at)), at], values, rcond=None)[0]
    return np.asarray(np.c_[np.ones(len(wanted)), wanted] @ solution)

"""Which places of a marker are looked at, and what is expected to be seen there.

These are the centres of its bits, then of the cells that are alike on all markers, then of the
quiet zone beside a black border. The values there are modelled as

    value = a + b x + c y + d * expected

with `expected` +1 for white and -1 for black: uneven light is a plane, d half the contrast.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from tagmetry.detect.reading.sample import Narrow, taps_of
from tagmetry.geometry import Array
from tagmetry.markers import Layout, MarkerFamily

_OUTSIDE_CELLS = 0.5
_TAP_CELLS = 0.17  # how far from a cell's centre its four taps are


class Places(NamedTuple):
    """What the markers of a layout share.

    Attributes:
        at: Centres in units of the square's side, shape (k, 2); the bits stand first.
        plain: What the places after the bits show: +1 is white, shape (k - bits,).
        quiet: How many of them, at the end, lie in the quiet zone.
        light: Orthonormal functions that 1, x, y of the places are made of, shape (k, 3).
        taps: Where values are taken for each, shape (2, 4 k).
        side_cells: Along a side of the square.
    """

    at: Array
    plain: Array
    quiet: int
    light: Array
    taps: Narrow
    side_cells: float


@cache
def places(layout: Layout) -> Places:
    """Return where markers of a layout are looked at."""
    black, white, quiet = layout.black_cells, layout.white_cells, _quiet_zone(layout)
    frame = (np.concatenate([black, white]) + 0.5) / layout.side_cells
    at = np.concatenate([layout.bit_centres, frame, quiet])
    plain = np.repeat([-1.0, 1.0], [len(black), len(white) + len(quiet)])
    light, _ = np.linalg.qr(np.column_stack([np.ones(len(at)), at - 0.5]))
    taps = taps_of(at, _TAP_CELLS / layout.side_cells)
    light = np.ascontiguousarray(light)
    return Places(at, plain, len(quiet), light, taps, float(layout.side_cells))


def expected(family: MarkerFamily, marker_id: int) -> Array:
    """Return what a marker's places show, +1 is white, shape (k,)."""
    bits = np.where(family.codes[marker_id], 1.0, -1.0)
    return np.concatenate([bits, places(family.layout).plain])


def _quiet_zone(layout: Layout) -> Array:
    """Return places beside a black border, shape (n, 2); beside others there are bits."""
    if layout.margin_cells:
        return np.empty((0, 2))
    side = layout.side_cells
    along = (np.arange(side) + 0.5) / side
    low, high = np.full(side, -_OUTSIDE_CELLS / side), np.full(side, 1 + _OUTSIDE_CELLS / side)
    pairs = [(along, low), (along, high), (low, along), (high, along)]
    return np.concatenate([np.stack(pair, axis=1) for pair in pairs])

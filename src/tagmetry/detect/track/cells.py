"""Which places of a marker are looked at, and what is expected to be seen there.

These are the centres of its bits, then of the cells that are alike on all markers, then of the
quiet zone beside a black border. The values there are modelled as

    value = a + b x + c y + d * expected

with `expected` +1 for white and -1 for black: uneven light is a plane, d half the contrast. With
the plane's three functions made orthonormal, d is the product of the values with one fixed vector.
"""

from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np

from tagmetry.geometry import Array
from tagmetry.markers import Layout, MarkerFamily

_OUTSIDE_CELLS = 0.5
_REMEMBERED = 4096  # markers


@dataclass(frozen=True, eq=False)
class Places:
    """What the markers of a layout share.

    Attributes:
        at: Centres in units of the square's side, shape (k, 2); the bits stand first.
        plain: What the places after the bits show: +1 is white, shape (k - bits,).
        quiet: How many of them, at the end, lie in the quiet zone.
        light: Orthonormal functions 1, x, y of the places, shape (k, 3).
    """

    at: Array
    plain: Array
    quiet: int
    light: Array


@cache
def places(layout: Layout) -> Places:
    """Return where markers of a layout are looked at."""
    black, white, quiet = layout.black_cells, layout.white_cells, _quiet_zone(layout)
    frame = (np.concatenate([black, white]) + 0.5) / layout.side_cells
    at = np.concatenate([layout.bit_centres, frame, quiet])
    plain = np.repeat([-1.0, 1.0], [len(black), len(white) + len(quiet)])
    light, _ = np.linalg.qr(np.column_stack([np.ones(len(at)), at - 0.5]))
    return Places(at, plain, len(quiet), light)


@lru_cache(_REMEMBERED)
def expected(family: MarkerFamily, marker_id: int) -> tuple[Array, Array]:
    """Return what a marker's places show, +1 is white, and the vector that gives its contrast.

    Both have shape (k,); the product of the second with the values is half the contrast.
    """
    seen = places(family.layout)
    white = np.concatenate([np.where(family.codes[marker_id], 1.0, -1.0), seen.plain])
    alone = white - seen.light @ (seen.light.T @ white)
    return white, alone / (alone @ alone)


def _quiet_zone(layout: Layout) -> Array:
    """Return places beside a black border, shape (n, 2); beside others there are bits."""
    if layout.margin_cells:
        return np.empty((0, 2))
    side = layout.side_cells
    along = (np.arange(side) + 0.5) / side
    low, high = np.full(side, -_OUTSIDE_CELLS / side), np.full(side, 1 + _OUTSIDE_CELLS / side)
    pairs = [(along, low), (along, high), (low, along), (high, along)]
    return np.concatenate([np.stack(pair, axis=1) for pair in pairs])

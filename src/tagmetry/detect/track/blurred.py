"""Is it still this marker where blur leaves bits unread? Only if no other explains it as well.

Blur mixes neighbouring cells, so a marker's picture p (+1 white, -1 black, at the k places that are
looked at) is seen as M p, with M a Gaussian between places. Of several M, round ones and ones along
directions of motion, the one is taken that fits the expected marker best. With r the correlation of
what is seen and what a marker would look like, the expected marker is more likely than another by

    log likelihood ratio = k (r_own^2 - r_other^2) / (2 (1 - r_own^2))

The ratio asked for is far above what noise needs, for M is not known so well.
"""

from collections.abc import Iterator
from functools import cache

import numpy as np

from tagmetry.detect.track.cells import places
from tagmetry.detect.track.sight import Sights
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import Layout, MarkerFamily

_LEAST_CORRELATION = 0.9
_LEAST_RATIO = 15.0
_LEAST_CONTRAST = 8.0  # grey values
_ROUND_CELLS = (0.3, 0.5, 0.7, 0.9, 1.1)  # standard deviations
_LONG_CELLS = (0.6, 0.9, 1.2)
_ACROSS_CELLS = 0.3
_DIRECTIONS_DEG = (0, 45, 90, 135)


def recognised(sights: Sights, rows: BoolArray) -> BoolArray:
    """Say which of some markers can be none other, though bits read wrong, shape (n,).

    Args:
        sights: How n markers look.
        rows: Which of them are asked about; the others are not recognised, shape (n,).
    """
    known = np.zeros(len(rows), dtype=bool)
    for row in np.flatnonzero(rows & sights.has_sides & (sights.contrast >= _LEAST_CONTRAST)):
        known[row] = _is_none_other(sights, int(row))
    return known


def _is_none_other(sights: Sights, row: int) -> bool:
    """Say whether a marker is the only one of its family that fits what is seen."""
    seen, own = _normal(sights.margins[row]), sights.expected(row)
    mixings = _mixings(sights.family.layout)
    fits = _normal(mixings @ own) @ seen
    best = int(fits.argmax())
    r_own = float(fits[best])
    bits = sights.family.layout.bit_count
    plain = mixings[best][:, bits:] @ own[bits:]
    r_other = 0.0
    for quarter, codes in enumerate(_codes(sights.family)):
        others = _normal(codes @ mixings[best][:, :bits].T + plain) @ seen
        if quarter == 0:
            others[sights.ids[row]] = 0.0
        r_other = max(r_other, float(others.max()))
    if r_own < max(_LEAST_CORRELATION, r_other):
        return False
    ratio = len(own) * (r_own**2 - r_other**2) / (2 * max(1 - r_own**2, 1e-9))
    return ratio >= _LEAST_RATIO


def _codes(family: MarkerFamily) -> Iterator[Array]:
    """Give all codes as -1 and +1, shape (ids, bits), upright and turned by 1, 2, 3 quarters."""
    for turned in family.layout.rotations:
        yield np.where(family.codes[:, turned], 1.0, -1.0)


def _normal(rows: Array) -> Array:
    """Return rows (..., k) less their means, of length 1, so that products are correlations."""
    centred = rows - rows.mean(axis=-1, keepdims=True)
    length = np.linalg.norm(centred, axis=-1, keepdims=True)
    return np.asarray(centred / np.maximum(length, 1e-12))


@cache
def _mixings(layout: Layout) -> Array:
    """Return how blurs mix what is seen at the places of a layout, shape (blurs, k, k)."""
    at = places(layout).at * layout.side_cells
    apart = at[:, None] - at
    weights = [np.exp(-0.5 * ((apart @ stretch) ** 2).sum(axis=2)) for stretch in _stretches()]
    return np.stack([one / one.sum(axis=1, keepdims=True) for one in weights])


def _stretches() -> list[Array]:
    """Return the matrices (2, 2) that turn places apart into standard deviations of each blur."""
    stretches = [np.eye(2) / cells for cells in _ROUND_CELLS]
    for angle in np.radians(_DIRECTIONS_DEG):
        along, across = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        stretches += [
            np.stack([along / cells, across / _ACROSS_CELLS], axis=1) for cells in _LONG_CELLS
        ]
    return stretches

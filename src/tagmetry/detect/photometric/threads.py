"""Markers shared out among threads: the kernels let go of the interpreter."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from tagmetry.detect.photometric.marker import fit_markers
from tagmetry.detect.workers import at_once, shares
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_LEAST_SHARE = 8  # markers: a millisecond, that waking a thread be worth it


def fit_by_threads(
    grey: GreyPixels,
    inks: Sequence[Array],
    numbers: tuple[Array, Array, Array, Array, BoolArray],
    threads: int,
) -> tuple[Array, ...]:
    """Return what `fit_markers` does, of n markers.

    Args:
        grey: The image.
        inks: The markers' pictures, n of them.
        numbers: Starts, frames, lenses, squares and bows as `fit_markers` takes them.
        threads: How many to use at most.
    """

    def fitted(share: slice) -> tuple[Array, ...]:
        own = inks[share]
        cells, sizes = np.concatenate([ink.ravel() for ink in own]), np.array([len(k) for k in own])
        starts, frames, lenses, squares, bows = numbers
        return fit_markers(
            grey,
            cells,
            sizes,
            starts[share],
            frames[share],
            lenses[share],
            squares[share],
            bows[share],
        )

    parts = shares(len(inks), _LEAST_SHARE, threads)
    if len(parts) == 1:
        return fitted(parts[0])
    done = at_once([partial(fitted, part) for part in parts])
    return tuple(np.concatenate(parts) for parts in zip(*done, strict=True))

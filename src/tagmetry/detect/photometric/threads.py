"""Markers shared out among threads: the kernels let go of the interpreter."""

from collections.abc import Sequence
from functools import partial
from itertools import pairwise

import numpy as np

from tagmetry.detect.photometric.marker import fit_markers
from tagmetry.detect.workers import at_once
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

    count = max(1, min(threads, len(inks) // _LEAST_SHARE))
    if count == 1:
        return fitted(slice(None))
    ends = np.linspace(0, len(inks), count + 1).astype(int)
    shares = [slice(int(a), int(b)) for a, b in pairwise(ends)]
    done = at_once([partial(fitted, share) for share in shares])
    return tuple(np.concatenate(parts) for parts in zip(*done, strict=True))

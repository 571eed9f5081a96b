"""Which of the found markers are the true ones."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray
from tagmetry.lab.bench.case import Truth
from tagmetry.lab.engines import Found

_NEAR = 0.5  # of a side, from middle to middle


@dataclass(frozen=True, eq=False)
class Matches:
    """Pairs of true and found markers of an image.

    Attributes:
        true: Which of the true ones, shape (k,).
        found: Which of the found ones, shape (k,).
        false: How many found ones are left over.
    """

    true: IntArray
    found: IntArray
    false: int


def matched(found: Found, truth: Truth) -> Matches:
    """Return for each true marker the nearest found one of its id, near it."""
    pairs: list[tuple[int, int]] = []
    free = set(range(len(found.ids)))
    for i, marker_id in enumerate(truth.ids):
        candidates = [j for j in free if found.ids[j] == marker_id]
        apart = [_apart(found.corners_px[j], truth.corners_px[i]) for j in candidates]
        if candidates and min(apart) < _NEAR:
            pairs.append((i, candidates[int(np.argmin(apart))]))
            free.remove(pairs[-1][1])
    both = np.array(pairs, dtype=np.int64).reshape(-1, 2)
    return Matches(both[:, 0], both[:, 1], len(free))


def _apart(corners_px: Array, others_px: Array) -> float:
    """Return the distance of two squares' middles by the side of the second."""
    side_px = np.linalg.norm(np.roll(others_px, 1, axis=0) - others_px, axis=1).mean()
    return float(np.linalg.norm((corners_px - others_px).mean(axis=0)) / side_px)

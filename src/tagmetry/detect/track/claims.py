"""Which of the lost markers were found again by searching, and which found ones are new."""

from collections.abc import Sequence

import numpy as np

from tagmetry.detect.choose import Candidate
from tagmetry.detect.track.known import Known
from tagmetry.detect.track.seen import Seen
from tagmetry.geometry.arrays import Array, BoolArray
from tagmetry.markers import MarkerFamily


def claimed(
    candidates: Sequence[Candidate],
    known: Known,
    is_lost: BoolArray,
    families: Sequence[MarkerFamily],
) -> Seen:
    """Return markers found by searching, each with the lost marker that it is.

    Args:
        candidates: What was found.
        known: The markers that are looked for, n.
        is_lost: Which were not seen where they were expected, shape (n,).
        families: Of the detector.
    """
    free, rows = is_lost.copy(), []
    for one in candidates:
        place = families.index(one.match.family)
        same = free & (known.tracks.families == place) & (known.tracks.ids == one.match.id)
        row = _nearest(same, known.corners_px, one.corners_px)
        if row >= 0:
            free[row] = False
        rows.append(row)
    return Seen.by_search(candidates, np.array(rows, dtype=np.int64), families)


def _nearest(same: BoolArray, corners_px: Array, found_px: Array) -> int:
    """Return which of some squares (n, 4, 2) is nearest to one, -1 if there is none."""
    rows = np.flatnonzero(same)
    if not len(rows):
        return -1
    apart_px = np.linalg.norm((corners_px[rows] - found_px).mean(axis=1), axis=1)
    return int(rows[apart_px.argmin()])

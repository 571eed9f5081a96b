"""Which of the lost markers were found again by searching, and which found ones are new."""

import numpy as np

from tagmetry.detect.candidates import Candidates
from tagmetry.detect.track.known import Known
from tagmetry.detect.track.seen import Seen
from tagmetry.geometry.arrays import Array, BoolArray


def claimed(found: Candidates, known: Known, is_lost: BoolArray) -> Seen:
    """Return markers found by searching, each with the lost marker that it is.

    Args:
        found: What was found.
        known: The markers that are looked for, n.
        is_lost: Which were not seen where they were expected, shape (n,).
    """
    free, rows = is_lost.copy(), np.full(len(found), -1)
    for k in range(len(found)) if free.any() else ():
        tracks = known.tracks
        same = free & (tracks.families == found.families[k]) & (tracks.ids == found.ids[k])
        rows[k] = _nearest(same, known.corners_px, found.corners_px[k])
        if rows[k] >= 0:
            free[rows[k]] = False
    return Seen.by_search(found, rows)


def _nearest(same: BoolArray, corners_px: Array, found_px: Array) -> int:
    """Return which of some squares (n, 4, 2) is nearest to one, -1 if there is none."""
    rows = np.flatnonzero(same)
    if not len(rows):
        return -1
    apart_px = np.linalg.norm((corners_px[rows] - found_px).mean(axis=1), axis=1)
    return int(rows[apart_px.argmin()])

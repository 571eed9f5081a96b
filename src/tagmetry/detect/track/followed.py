"""What is known after an image: those that it showed, and for a while those that it did not."""

from dataclasses import replace

import numpy as np

from tagmetry.detect.exact import Exact
from tagmetry.detect.track.known import Known
from tagmetry.detect.track.motion import moved
from tagmetry.detect.track.seen import Seen
from tagmetry.detect.track.tracks import Tracks
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray


def followed(known: Known, seen: Seen, exact: Exact, time_s: float, forget_s: float) -> Tracks:
    """Return the markers to follow into the next image.

    Args:
        known: The markers that were looked for.
        seen: The m markers that it shows.
        exact: Where exactly, and how they look.
        time_s: Time of this image.
        forget_s: For how long markers are followed that are not seen.
    """
    corners_px, looks = exact.corners_px, exact.looks
    continues = _go_on(known, seen, corners_px)
    rows, new = seen.rows[continues], seen.at(~continues)
    going_on = moved(known.tracks.at(rows), known.corners_px[rows], corners_px[continues], time_s)
    begun = Tracks.begun(new.families, new.ids, new.is_inverted, corners_px[~continues], time_s)
    there = going_on.and_also(begun)
    looks = np.concatenate([looks[continues], looks[~continues]])
    waiting = _waiting(known.tracks, seen, time_s - forget_s)
    return replace(there, looks=looks).and_also(waiting)


def _go_on(known: Known, seen: Seen, corners_px: Array) -> BoolArray:
    """Say which of the m seen markers go on moving as before, shape (m,).

    Those that were announced begin anew, and those found farther off than they can have come.
    """
    goes_on = seen.rows >= 0
    rows = seen.rows[goes_on]
    off_px = np.linalg.norm((corners_px[goes_on] - known.corners_px[rows]).mean(axis=1), axis=1)
    goes_on[goes_on] = (off_px <= known.reach_px[rows]) & np.isfinite(known.tracks.seen_s[rows])
    return goes_on


def _waiting(known: Tracks, seen: Seen, oldest_s: float) -> Tracks:
    """Return the markers that were not seen, but for those not seen since a time."""
    kept = known.seen_s >= oldest_s
    kept[seen.rows[seen.rows >= 0]] = False
    waiting = known.at(kept)
    return replace(waiting, missed=waiting.missed + 1)

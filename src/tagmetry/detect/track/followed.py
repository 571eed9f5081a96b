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
    corners_px, continues = exact.corners_px, _go_on(known, seen, exact.corners_px)
    rows = seen.rows[continues]
    tracks = moved(known.tracks.at(rows), known.corners_px[rows], corners_px[continues], time_s)
    tracks = replace(tracks, looks=exact.looks[continues])
    if not continues.all():
        new, at = seen.at(~continues), exact.at(~continues)
        begun = Tracks.begun(new.families, new.ids, new.is_inverted, at.corners_px, time_s)
        tracks = tracks.and_also(replace(begun, looks=at.looks))
    return tracks.and_also(_waiting(known.tracks, seen, time_s - forget_s))


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

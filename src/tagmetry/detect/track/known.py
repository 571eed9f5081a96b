"""What is known before an image is looked at: the followed markers, and those announced for it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.detect.track.motion import predicted
from tagmetry.detect.track.tracks import Tracks
from tagmetry.geometry import Array

_LONGEST_S = 0.2  # for a longer time nobody knows where a marker went
_SIGMAS = 3.0
_QUIET_PX = 8.0  # around a marker that are needed to see it


@dataclass(frozen=True, eq=False)
class Announced:
    """A marker that a caller expects in the next image.

    Attributes:
        family: Place of its family in the detector's list.
        id: Its id.
        corners_px: Where, shape (4, 2).
        deviation_px: How far it may be from there, standard deviation.
        is_inverted: White on black.
    """

    family: int
    id: int
    corners_px: Array
    deviation_px: float
    is_inverted: bool


@dataclass(frozen=True, eq=False)
class Known:
    """n markers that are looked for in an image.

    Attributes:
        tracks: What is known of them.
        corners_px: Where they are expected, shape (n, 4, 2).
        deviation_px: How far each may be from there, standard deviation, shape (n,).
        reach_px: How far from there it is searched for, shape (n,).
    """

    tracks: Tracks
    corners_px: Array
    deviation_px: Array
    reach_px: Array


def known_at(
    tracks: Tracks,
    announced: Sequence[Announced],
    time_s: float,
    since_s: float,
    fastest_px_s: float,
) -> Known:
    """Return what to look for at a time, and where: where announced, else by its own motion.

    Args:
        tracks: The followed markers.
        announced: Markers expected by a caller; those that are not followed are added.
        time_s: Time of the image.
        since_s: Time since the last image: any marker may have changed its motion since.
        fastest_px_s: How fast a marker may be that was seen once, and by how much motion changes.
    """
    told = [_row_of(tracks, one) for one in announced]
    strangers = [one for one, row in zip(announced, told, strict=True) if row is None]
    where = predicted(tracks, time_s, fastest_px_s)
    corners_px, deviation_px = where.corners_px, where.deviation_px
    for one, row in zip(announced, told, strict=True):
        if row is not None:
            corners_px[row], deviation_px[row] = one.corners_px, one.deviation_px
    if strangers:
        added = _tracks_of(strangers)
        tracks = tracks.and_also(added)
        corners_px = np.concatenate([corners_px, added.corners_px])
        deviation_px = np.append(deviation_px, [one.deviation_px for one in strangers])
    change_px = fastest_px_s * min(since_s, _LONGEST_S)
    reach_px = _QUIET_PX + np.clip(_SIGMAS * deviation_px, change_px, 2 * change_px)
    return Known(tracks, corners_px, deviation_px, reach_px)


def _row_of(tracks: Tracks, one: Announced) -> int | None:
    """Return the followed marker that is announced, the nearest one of several."""
    rows = np.flatnonzero((tracks.families == one.family) & (tracks.ids == one.id))
    if not len(rows):
        return None
    apart_px = tracks.corners_px[rows].mean(axis=1) - one.corners_px.mean(axis=0)
    return int(rows[np.linalg.norm(apart_px, axis=1).argmin()])


def _tracks_of(strangers: Sequence[Announced]) -> Tracks:
    return Tracks.begun(
        np.array([one.family for one in strangers]),
        np.array([one.id for one in strangers]),
        np.array([one.is_inverted for one in strangers]),
        np.stack([one.corners_px for one in strangers]),
        np.nan,
    )

"""What is said of a marker that was followed and is not seen in this image."""

from collections.abc import Sequence
from dataclasses import dataclass

from tagmetry.detect.track.motion import predicted
from tagmetry.detect.track.tracks import Tracks
from tagmetry.geometry import Array
from tagmetry.markers import MarkerFamily


@dataclass(frozen=True, eq=False)
class Lost:
    """A marker that is still looked for where it should be.

    Attributes:
        family: Name of its family.
        id: Its id.
        corners_px: Where it is expected in the last image, shape (4, 2); nothing was seen there.
        deviation_px: How far it may be from there, standard deviation.
        age_s: For how long it has not been seen.
    """

    family: str
    id: int
    corners_px: Array
    deviation_px: float
    age_s: float


def lost_of(
    tracks: Tracks, families: Sequence[MarkerFamily], time_s: float, fastest_px_s: float
) -> tuple[Lost, ...]:
    """Return what is said of markers at a time when they are not seen.

    Args:
        tracks: The markers.
        families: Of the detector.
        time_s: Time of the image.
        fastest_px_s: No marker is faster when it is first seen.
    """
    where = predicted(tracks, time_s, fastest_px_s)
    names = [families[place].name for place in tracks.families.tolist()]
    ages_s, deviations_px = (time_s - tracks.seen_s).tolist(), where.deviation_px.tolist()
    each = zip(names, tracks.ids.tolist(), where.corners_px, deviations_px, ages_s, strict=True)
    return tuple(Lost(*one) for one in each)

"""Where will a marker be? It goes on as it moved between the last two images that showed it.

The middle goes straight on; the square around it goes on turning and growing at the same rates (a
similarity, as complex numbers), so that a marker on a turning robot is met as well. How far it may
be from there comes from its own past: the acceleration by which it was last mispredicted, which is
held and fades slowly. The prediction only says where to look: what is reported is measured in the
image alone.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.detect.track.tracks import Tracks
from tagmetry.geometry import Array

_LEAST_PX = 0.3  # standard deviation of the best prediction
_FADING = 0.8  # of the acceleration, per image
_UNSTEADY = 1 / 3  # of its first known velocity, that a marker may lose within one image
_SIGMAS = 3.0


@dataclass(frozen=True, eq=False)
class Predicted:
    """Where markers are expected.

    Attributes:
        corners_px: Shape (n, 4, 2).
        deviation_px: How far each may be from there, standard deviation, shape (n,).
    """

    corners_px: Array
    deviation_px: Array


def predicted(tracks: Tracks, time_s: float, fastest_px_s: float) -> Predicted:
    """Return where markers are expected at a time.

    Args:
        tracks: The markers, n.
        time_s: Not before they were seen.
        fastest_px_s: No marker is faster when it is first seen.
    """
    since_s = time_s - tracks.seen_s
    middle = tracks.corners_px.mean(axis=1)
    around = _complex(tracks.corners_px - middle[:, None])
    around = around * np.exp(tracks.spin_s * since_s)[:, None]
    ahead = middle + tracks.drift_px_s * since_s[:, None]
    corners_px = np.stack([around.real, around.imag], axis=2) + ahead[:, None]
    doubt_px = np.where(
        tracks.is_new, fastest_px_s / _SIGMAS * since_s, tracks.shake_px_s2 * since_s**2
    )
    return Predicted(corners_px, np.hypot(_LEAST_PX, doubt_px))


def moved(tracks: Tracks, expected_px: Array, corners_px: Array, time_s: float) -> Tracks:
    """Return markers with what was learned from seeing them.

    Args:
        tracks: As they were before this image, n.
        expected_px: Where they were expected, shape (n, 4, 2).
        corners_px: Where they are, shape (n, 4, 2).
        time_s: Time of this image.
    """
    since_s = time_s - tracks.seen_s
    before, now = tracks.corners_px.mean(axis=1), corners_px.mean(axis=1)
    drift_px_s = (now - before) / since_s[:, None]
    z_before = _complex(tracks.corners_px - before[:, None])
    z_now = _complex(corners_px - now[:, None])
    similar = (z_before.conj() * z_now).sum(axis=1) / (abs(z_before) ** 2).sum(axis=1)
    off_px = np.sqrt(((corners_px - expected_px) ** 2).sum(axis=2).mean(axis=1))
    first_px_s2 = _UNSTEADY * np.linalg.norm(drift_px_s, axis=1) / since_s
    later_px_s2 = np.maximum(off_px / since_s**2, _FADING * tracks.shake_px_s2)
    return replace(
        tracks,
        corners_px=corners_px,
        seen_s=np.full(len(tracks), time_s),
        drift_px_s=drift_px_s,
        spin_s=np.log(similar) / since_s,
        shake_px_s2=np.where(tracks.is_new, first_px_s2, later_px_s2),
        is_new=np.zeros(len(tracks), dtype=bool),
        missed=np.zeros(len(tracks), dtype=np.int64),
    )


def _complex(places: Array) -> "np.ndarray[tuple[int, ...], np.dtype[np.complex128]]":
    """Return places (..., 2) as x + iy."""
    return np.asarray(places[..., 0] + 1j * places[..., 1])

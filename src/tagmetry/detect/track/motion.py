"""Where will a marker be? It goes on as it moved between the last two images that showed it.

The middle goes straight on; the square around it goes on turning and growing at the same rates (a
similarity, as complex numbers), so that a marker on a turning robot is met as well. How far it may
be from there comes from its own past: the acceleration by which it was last mispredicted, which is
held and fades slowly. The prediction only says where to look: what is reported is measured in the
image alone.
"""

from dataclasses import dataclass, replace

import numpy as np
from numba import njit

from tagmetry.detect.track.tracks import Spins, Tracks
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
    corners_px = _ahead(tracks.corners_px, tracks.drift_px_s, tracks.spin_s, since_s)
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
    drift_px_s, spin_s = _rates(tracks.corners_px, corners_px, since_s)
    off_px = np.sqrt(((corners_px - expected_px) ** 2).sum(axis=2).mean(axis=1))
    first_px_s2 = _UNSTEADY * np.hypot(drift_px_s[:, 0], drift_px_s[:, 1]) / since_s
    later_px_s2 = np.maximum(off_px / since_s**2, _FADING * tracks.shake_px_s2)
    return replace(
        tracks,
        corners_px=corners_px,
        seen_s=np.full(len(tracks), time_s),
        drift_px_s=drift_px_s,
        spin_s=spin_s,
        shake_px_s2=np.where(tracks.is_new, first_px_s2, later_px_s2),
        is_new=np.zeros(len(tracks), dtype=bool),
        missed=np.zeros(len(tracks), dtype=np.int64),
    )


@njit(cache=True, nogil=True)
def _ahead(corners_px: Array, drift_px_s: Array, spin_s: Spins, since_s: Array) -> Array:
    """Return squares that went on drifting and turning for some times, shape (n, 4, 2)."""
    ahead_px = np.empty_like(corners_px)
    for i in range(len(corners_px)):
        middle, turn = _middle(corners_px[i]), np.exp(spin_s[i] * since_s[i])
        drift = complex(drift_px_s[i, 0], drift_px_s[i, 1]) * since_s[i]
        for k in range(4):
            around = complex(corners_px[i, k, 0], corners_px[i, k, 1]) - middle
            there = middle + drift + around * turn
            ahead_px[i, k, 0], ahead_px[i, k, 1] = there.real, there.imag
    return ahead_px


@njit(cache=True, nogil=True, error_model="numpy")
def _rates(before_px: Array, now_px: Array, since_s: Array) -> tuple[Array, Spins]:
    """Return how squares drifted and turned from one place to another, shapes (n, 2) and (n,)."""
    drift_px_s, spin_s = np.empty((len(now_px), 2)), np.empty(len(now_px), np.complex128)
    for i in range(len(now_px)):
        before, now = _middle(before_px[i]), _middle(now_px[i])
        similar, size = 0j, 0.0
        for k in range(4):
            was = complex(before_px[i, k, 0], before_px[i, k, 1]) - before
            similar += was.conjugate() * (complex(now_px[i, k, 0], now_px[i, k, 1]) - now)
            size += was.real**2 + was.imag**2
        drift = (now - before) / since_s[i]
        drift_px_s[i, 0], drift_px_s[i, 1] = drift.real, drift.imag
        spin_s[i] = np.log(similar / size) / since_s[i]
    return drift_px_s, spin_s


@njit(cache=True, nogil=True)
def _middle(square_px: Array) -> complex:
    """Return the middle of a square as x + iy."""
    middle = 0j
    for k in range(4):
        middle += complex(square_px[k, 0], square_px[k, 1]) / 4
    return middle

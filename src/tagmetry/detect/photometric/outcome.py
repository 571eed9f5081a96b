"""From fits to what is reported: which to take, corners and covariances in pixels."""

import numpy as np

from tagmetry.detect.photometric.bows import believed
from tagmetry.detect.photometric.fit import EXPONENTS
from tagmetry.detect.photometric.kernel import kernel
from tagmetry.detect.photometric.marker import SETTLED_PX
from tagmetry.detect.photometric.model import BLACK, BLUR, BOWS, EXPONENT, LOOK_COUNT, LOOKS
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_FLOOR_PX = 0.0007  # what neither model nor noise describe
_SHARP_PX2 = 0.15  # of a blur, the pixel's own square in it; of sharper ones the floor is higher
_LOST_PX = (2.5, 0.05)  # a corner that moved farther was another's; at least, and of the diagonal
_LEAST_CONTRAST = 4.0  # in noises
_MOST_DEVIATION_PX = 1.5


@kernel
def outcomes(
    fits: Array,
    places: Array,
    joints: Array,
    noises: Array,
    moves_px: Array,
    frames: Array,
    first_px: Array,
) -> tuple[Array, Array, BoolArray, Array]:
    """Return corners (n, 4, 2), covariances (n, 8, 8), which are sound (n,), and looks (n, 11).

    Args:
        fits: This and the next four as `fit_markers` returns them.
        places: See there.
        joints: See there.
        noises: See there.
        moves_px: See there.
        frames: Middle x, y and half diagonal of the markers, pixels, shape (n, 3).
        first_px: Corners where the fits began, kept where a fit is not sound, shape (n, 4, 2).
    """
    count = len(fits)
    sound, tells = np.zeros(count, dtype=np.bool_), np.zeros(count, dtype=np.bool_)
    for k in range(count):
        sound[k] = _explains(fits[k], noises[k], moves_px[k])
        tells[k] = sound[k] and np.diag(joints[k])[8:].min() > 0.0
    corners, covariances = _as_believed(fits, places, joints, frames, tells)
    looks = np.full((count, LOOK_COUNT), np.nan)
    for k in range(count):
        half_px = frames[k, 2]
        corners[k] = frames[k, :2] + half_px * corners[k]
        covariances[k] = half_px**2 * covariances[k] + _floor_px(fits[k], half_px) ** 2 * np.eye(8)
        sound[k] &= _plausible(corners[k], covariances[k], first_px[k], half_px)
        if sound[k]:
            looks[k] = fits[k, LOOKS]
        else:
            corners[k] = first_px[k]
    return corners, covariances, sound, looks


@kernel
def _as_believed(
    fits: Array, places: Array, joints: Array, frames: Array, tells: BoolArray
) -> tuple[Array, Array]:
    """Return corners and covariances, in half diagonals, where bows tell after those are judged."""
    corners, covariances = places.copy(), joints[:, :8, :8].copy()
    which = np.flatnonzero(tells)
    if len(which) > 0:
        better, left = believed(places[which], joints[which], frames[which, 2], fits[which, BOWS:])
        for at, k in enumerate(which):
            corners[k], covariances[k] = better[at], left[at]
    return corners, covariances


@kernel
def _floor_px(fit: Array, half_px: float) -> float:
    """Return the deviation that is added to every coordinate: the more, the sharper the blur."""
    blur_px2 = half_px**2 * min(fit[BLUR], fit[BLUR + 2])
    return float(_FLOOR_PX * max(1.0, _SHARP_PX2 / max(blur_px2, 1e-9)) ** 3)


@kernel
def _explains(fit: Array, noise: float, moved_px: float) -> bool:
    """Say whether a fit settled on a picture whose contrast stands out of the noise."""
    contrast = 255 * abs(fit[BLACK + 1] - fit[BLACK])
    meant = EXPONENTS[0] < fit[EXPONENT] < EXPONENTS[1]
    return bool(moved_px < SETTLED_PX and contrast > _LEAST_CONTRAST * noise and meant)


@kernel
def _plausible(corners_px: Array, covariance_px2: Array, first_px: Array, half_px: float) -> bool:
    """Say whether a fit stayed with the marker that it began with."""
    most_px = max(_LOST_PX[0], _LOST_PX[1] * half_px)
    for k in range(4):
        moved_px = np.hypot(corners_px[k, 0] - first_px[k, 0], corners_px[k, 1] - first_px[k, 1])
        if not moved_px < most_px:
            return False
    variances = np.diag(covariance_px2)
    known = variances.min() > 0.0 and variances.max() < _MOST_DEVIATION_PX**2
    return bool(known and np.isfinite(covariance_px2).all())

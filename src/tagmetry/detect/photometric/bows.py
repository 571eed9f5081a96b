"""How far to believe that straight edges bow, where the lens is not known.

Every marker large enough tells five bows with their errors. How strongly this image bows is judged
on all of its markers together: the spread of the bows beyond their own errors (DerSimonian and
Laird's moment) is what each marker's bows are believed with. So a straight image costs no accuracy,
and a bowed one no honesty.
"""

import numpy as np

from tagmetry.detect.photometric.kernel import kernel
from tagmetry.geometry import Array

_DOUBT = 2.0  # deviations by which the bows must exceed their errors to be believed at all
_LEAST_VARIANCE = 1e-18


@kernel
def believed(
    corners: Array, covariances: Array, half_px: Array, bows: Array
) -> tuple[Array, Array]:
    """Return corners, (n, 4, 2), and covariances, (n, 8, 8), after what is believed of the bows.

    Args:
        corners: As fitted with the bows free, in units of `half_px`, shape (n, 4, 2).
        covariances: Of the corners and the bows, shape (n, 13, 13).
        half_px: Half diagonals of the markers, shape (n,).
        bows: Shape (n, 5).
    """
    spread2 = np.zeros(bows.shape)
    _write_spread2(spread2, bows, covariances, half_px, (0, 4))  # curved alike everywhere
    _write_spread2(spread2, bows, covariances, half_px, (4, 5))  # a barrel around the marker itself
    moved, left = corners.copy(), np.empty((len(corners), 8, 8))
    for k in range(len(corners)):
        joint, numbers = covariances[k].copy(), np.zeros(13)
        numbers[8:] = bows[k]
        for bow in range(5):
            _expect_none(numbers, joint, 8 + bow, spread2[k, bow])
        moved[k] += numbers[:8].reshape(4, 2)
        left[k] = joint[:8, :8]
    return moved, left


@kernel
def _expect_none(numbers: Array, joint: Array, which: int, spread2: float) -> None:
    """Change numbers and their covariance by what a number being 0, but for a spread, says."""
    off, total = numbers[which], joint[which, which] + spread2
    by_it = joint[:, which].copy()
    for a in range(len(numbers)):
        numbers[a] -= by_it[a] * off / total
        for b in range(len(numbers)):
            joint[a, b] -= by_it[a] * by_it[b] / total


@kernel
def _write_spread2(
    spread2: Array, bows: Array, covariances: Array, half_px: Array, kind: tuple[int, int]
) -> None:
    """Write the variance of one kind of bow in this image, per marker; leave 0 if it is none."""
    first, last = kind
    squares, weights, count = 0.0, 0.0, len(bows) * (last - first)
    for k in range(len(bows)):
        for bow in range(first, last):
            variance = max(covariances[k, 8 + bow, 8 + bow], _LEAST_VARIANCE)
            squares += bows[k, bow] ** 2 / variance
            weights += _growth2(half_px[k], first) / variance
    if not squares < count + _DOUBT * np.sqrt(2 * count):
        for k in range(len(bows)):
            spread2[k, first:last] = (squares - count) / weights * _growth2(half_px[k], first)


@kernel
def _growth2(half_px: float, first: int) -> float:
    """Return how bows grow with the marker, squared; a barrel's twice as fast."""
    return float(half_px ** (2 if first == 0 else 4))

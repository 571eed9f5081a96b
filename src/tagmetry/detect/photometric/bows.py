"""How far to believe that straight edges bow, where the lens is not known.

Every marker large enough tells five bows with their errors. How strongly this image bows is judged
on all of its markers together: the spread of the bows beyond their own errors (DerSimonian and
Laird's moment) is what each marker's bows are believed with. So a straight image costs no accuracy,
and a bowed one no honesty.
"""

import numpy as np

from tagmetry.geometry import Array

_DOUBT = 2.0  # deviations by which the bows must exceed their errors to be believed at all
_KINDS = (slice(0, 4), slice(4, 5))  # curved alike everywhere; a barrel around the marker itself


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
    spread2 = np.concatenate(
        [_spread2(bows[:, kind], covariances, half_px, kind) for kind in _KINDS], axis=1
    )
    by_bows = covariances[:, :, 8:]
    total = by_bows[:, 8:] + spread2[:, :, None] * np.eye(5)
    gain = np.linalg.solve(total, np.swapaxes(by_bows, 1, 2)).swapaxes(1, 2)
    moved = (gain @ bows[:, :, None])[:, :8, 0]
    left = covariances - gain @ np.swapaxes(by_bows, 1, 2)
    return corners - moved.reshape(-1, 4, 2), left[:, :8, :8]


def _spread2(bows: Array, covariances: Array, half_px: Array, kind: slice) -> Array:
    """Return the variance of one kind of bow in this image, per marker, shape like `bows`."""
    own = slice(8 + kind.start, 8 + kind.stop)
    variance = np.maximum(np.einsum("nii->ni", covariances[:, own, own]), 1e-18)
    scale = half_px[:, None] ** (1 + kind.start // 4)  # bows grow with the marker
    weight = scale**2 / variance
    squares, count = (bows**2 / variance).sum(), bows.size
    if squares < count + _DOUBT * np.sqrt(2 * count):
        return np.zeros_like(bows)
    return np.asarray((squares - count) / weight.sum() * scale**2 * np.ones_like(bows))

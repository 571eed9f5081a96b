"""Zhang's closed form: homographies of a flat board to the camera matrix and the board's poses.

A homography is H = [h1 h2 h3] ~ K [r1 r2 t]. As r1 and r2 are orthogonal and of one length, each
view constrains B = K^-T K^-1 twice (his equations 3 and 4):

    h1^T B h2 = 0,    h1^T B h1 = h2^T B h2

Reference: Z. Zhang, A Flexible New Technique for Camera Calibration, PAMI 22(11), 2000,
section 3.1 and appendix B.
"""

import numpy as np

from tagmetry.geometry import Array


def closed_form(H: Array) -> Array | None:
    """Return K without skew from homographies (n, 3, 3); None where they do not determine it.

    Homographies must be of pixels scaled to about one around the image centre, so that the six
    numbers of B are of one size.
    """
    rows = np.concatenate([_v(H, 0, 1), _v(H, 0, 0) - _v(H, 1, 1)])  # his equation 8: V b = 0
    no_skew = np.array([[0.0, 1.0, 0.0, 0.0, 0.0, 0.0]])
    _, _, axes = np.linalg.svd(np.concatenate([rows, np.abs(rows).max() * len(rows) * no_skew]))
    B11, B12, B22, B13, B23, B33 = axes[-1]
    below = B11 * B22 - B12**2
    if abs(B11) < 1e-12 or abs(below) < 1e-24:
        return None
    v0 = (B12 * B13 - B11 * B23) / below  # his appendix B
    scale = B33 - (B13**2 + v0 * (B12 * B13 - B11 * B23)) / B11
    alpha2, beta2 = scale / B11, scale * B11 / below
    if not (alpha2 > 0 and beta2 > 0):
        return None
    alpha, beta = np.sqrt(alpha2), np.sqrt(beta2)
    return np.array([[alpha, 0.0, -B13 * alpha2 / scale], [0.0, beta, v0], [0.0, 0.0, 1.0]])


def focal_lengths(H: Array) -> Array:
    """Return focal lengths that views tell with the principal point at the origin, ascending.

    With K = diag(f, f, 1) each of Zhang's two equations of a view gives 1 / f^2 by itself:

        (h11 h12 + h21 h22) / f^2 + h31 h32 = 0
        (h11^2 + h21^2 - h12^2 - h22^2) / f^2 + h31^2 - h32^2 = 0
    """
    along = np.concatenate([H[:, 0, 0] * H[:, 0, 1] + H[:, 1, 0] * H[:, 1, 1], _squares(H, 0, 1)])
    ahead = np.concatenate([H[:, 2, 0] * H[:, 2, 1], H[:, 2, 0] ** 2 - H[:, 2, 1] ** 2])
    with np.errstate(divide="ignore", invalid="ignore"):
        squared = -along / ahead
    return np.sort(np.sqrt(squared[np.isfinite(squared) & (squared > 0)]))


def least_squares_focal(H: Array) -> float:
    """Return the one focal length that fits all of the equations above; NaN where none does."""
    along = np.concatenate([H[:, 0, 0] * H[:, 0, 1] + H[:, 1, 0] * H[:, 1, 1], _squares(H, 0, 1)])
    ahead = np.concatenate([H[:, 2, 0] * H[:, 2, 1], H[:, 2, 0] ** 2 - H[:, 2, 1] ** 2])
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.sqrt(-(along @ along) / (along @ ahead)))


def poses_from_homographies(K: Array, H: Array) -> tuple[Array, Array]:
    """Return R, shape (n, 3, 3), and t, shape (n, 3), of the board's plane in the camera.

    The board is in front of the camera. R is the nearest rotation to [r1 r2 r1 x r2] (his
    appendix C).
    """
    columns = np.linalg.inv(K) @ H
    length = np.linalg.norm(columns[:, :, :2], axis=1).mean(axis=1)
    columns = columns * (np.sign(columns[:, 2, 2]) / np.maximum(length, 1e-300))[:, None, None]
    r1, r2, t = np.moveaxis(columns, 2, 0)
    left, _, right = np.linalg.svd(np.stack([r1, r2, np.cross(r1, r2)], axis=-1))
    R = left @ right
    return np.asarray(R * np.sign(np.linalg.det(R))[:, None, None]), t


def _v(H: Array, i: int, j: int) -> Array:
    """Return v_ij with v_ij . b = h_i^T B h_j (his equation 7), shape (n, 6)."""
    a, b = H[:, :, i], H[:, :, j]
    terms = [
        a[:, 0] * b[:, 0],
        a[:, 0] * b[:, 1] + a[:, 1] * b[:, 0],
        a[:, 1] * b[:, 1],
        a[:, 2] * b[:, 0] + a[:, 0] * b[:, 2],
        a[:, 2] * b[:, 1] + a[:, 1] * b[:, 2],
        a[:, 2] * b[:, 2],
    ]
    return np.stack(terms, axis=-1)


def _squares(H: Array, i: int, j: int) -> Array:
    return np.asarray((H[:, :2, i] ** 2).sum(axis=1) - (H[:, :2, j] ** 2).sum(axis=1))

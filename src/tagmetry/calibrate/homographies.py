"""Homographies of a flat board in many views at once, by the normalised direct linear transform.

Reference: R. Hartley, A. Zisserman, Multiple View Geometry, 2004, algorithm 4.2; Zhang 2000,
appendix A.
"""

import numpy as np

from tagmetry.geometry import Array


def fit_homographies(xy: Array, pixels: Array, weights: Array) -> Array:
    """Return H with `pixel ~ H (x, y, 1)` for each view, shape (n, 3, 3).

    Args:
        xy: The board's points in its plane, shape (k, 2).
        pixels: Shape (n, k, 2).
        weights: Shape (n, k), zero for points that a view does not show.
    """
    to_board = _normalisation(np.broadcast_to(xy, pixels.shape), weights)
    to_image = _normalisation(pixels, weights)
    x = _normalised(to_board, np.broadcast_to(xy, pixels.shape))
    u = _normalised(to_image, pixels)
    rows = _equations(x, u) * np.sqrt(weights)[:, :, None, None]
    rows = rows.reshape(len(pixels), -1, 9)
    _, vectors = np.linalg.eigh(np.swapaxes(rows, 1, 2) @ rows)
    H = np.linalg.inv(to_image) @ vectors[:, :, 0].reshape(-1, 3, 3) @ to_board
    return np.asarray(H / np.linalg.norm(H, axis=(1, 2), keepdims=True))


def _equations(x: Array, u: Array) -> Array:
    """Return the two rows a point gives for the 9 numbers of H, shape (n, k, 2, 9)."""
    ones, zeros = np.ones_like(x[..., :1]), np.zeros((*x.shape[:-1], 3))
    point = np.concatenate([x, ones], axis=-1)
    first = np.concatenate([point, zeros, -u[..., :1] * point], axis=-1)
    second = np.concatenate([zeros, point, -u[..., 1:] * point], axis=-1)
    return np.stack([first, second], axis=-2)


def _normalisation(points: Array, weights: Array) -> Array:
    """Return the scaling and shift to mean zero and mean square distance 2, shape (n, 3, 3)."""
    share = weights / weights.sum(axis=1, keepdims=True)
    centre = np.einsum("nk,nki->ni", share, points)
    spread = np.einsum("nk,nki->n", share, (points - centre[:, None]) ** 2)
    scale = np.sqrt(2 / np.maximum(spread, 1e-300))
    T = np.zeros((len(points), 3, 3))
    T[:, 0, 0] = T[:, 1, 1] = scale
    T[:, :2, 2] = -scale[:, None] * centre
    T[:, 2, 2] = 1
    return T


def _normalised(T: Array, points: Array) -> Array:
    return np.asarray(points * T[:, None, :1, 0] + T[:, None, :2, 2])

"""The projective map between a square and its picture, in closed form.

Reference: P. Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989, section 2.2.3.
"""

import numpy as np

from tagmetry.geometry.arrays import Array


def square_to_quad(corners: Array) -> Array:
    """Return the homography from the unit square to quadrilaterals.

    Args:
        corners: Images of (0, 0), (1, 0), (1, 1), (0, 1), shape (..., 4, 2).

    Returns:
        H with `H @ (u, v, 1) ~ (x, y, 1)`, shape (..., 3, 3); singular or not finite for three
        corners on a line.
    """
    x0, y0, x1, y1, x2, y2, x3, y3 = (
        np.asarray(corners, dtype=np.float64)[..., i, k] for i in range(4) for k in range(2)
    )
    sum_x, sum_y = x0 - x1 + x2 - x3, y0 - y1 + y2 - y3
    dx1, dy1, dx2, dy2 = x1 - x2, y1 - y2, x3 - x2, y3 - y2
    H = np.empty((*np.shape(x0), 3, 3))
    with np.errstate(divide="ignore", invalid="ignore"):
        determinant = dx1 * dy2 - dx2 * dy1
        g = (sum_x * dy2 - dx2 * sum_y) / determinant
        h = (dx1 * sum_y - sum_x * dy1) / determinant
        H[..., 0, 0], H[..., 0, 1], H[..., 0, 2] = x1 - x0 + g * x1, x3 - x0 + h * x3, x0
        H[..., 1, 0], H[..., 1, 1], H[..., 1, 2] = y1 - y0 + g * y1, y3 - y0 + h * y3, y0
    H[..., 2, 0], H[..., 2, 1], H[..., 2, 2] = g, h, 1.0
    return H


def apply_homography(H: Array, points: Array) -> Array:
    """Return the images of points.

    Args:
        H: Shape (..., 3, 3).
        points: Shape (..., n, 2).
    """
    mapped = points @ np.swapaxes(H[..., :2], -1, -2) + H[..., None, :, 2]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(mapped[..., :2] / mapped[..., 2:])

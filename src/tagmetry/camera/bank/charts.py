"""Viewing rays as two numbers each.

A ray (x, y, z) of length one is written q = (x, y) / (1 + z), which holds beyond 90 degrees too;
p(q) = (2 q, 1 - |q|^2) lies on it.
"""

import numpy as np

from tagmetry.camera.model import Camera
from tagmetry.geometry.arrays import Array


def chart(rays: Array) -> Array:
    """Return q of unit rays."""
    return np.asarray(rays[..., :2] / (1 + rays[..., 2:]))


def points_on(q: Array) -> Array:
    """Return points on the rays q."""
    return np.concatenate([2 * q, 1 - (q**2).sum(axis=-1, keepdims=True)], axis=-1)


def ray_jacobian(camera: Camera, points: Array) -> Array:
    """Return how the ray of a fixed pixel, as q, follows the parameters, but for its sign.

    The sign cancels that of the fit, which moves against a ray that moved.
    """
    by_q = by_chart(camera, points)
    return np.asarray(np.linalg.solve(by_q, camera.parameter_jacobian(points)))


def by_chart(camera: Camera, points: Array) -> Array:
    """Return d(pixel) / dq of points on the rays q, shape (..., 2, 2)."""
    _, by_point = camera.project_with_jacobian(points)
    point_by_q = np.broadcast_to(np.eye(3, 2) * 2, (*points.shape[:-1], 3, 2)).copy()
    point_by_q[..., 2, :] = -points[..., :2]
    return np.asarray(by_point @ point_by_q)

"""Angles and rotations live on a circle and a sphere: how to average them there.

Seed 002 averages angles as atan(sum sin / sum cos); that loses two quadrants and divides by zero.
Here it is atan2, with the weights inside both sums.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array


def wrap_angle_rad(angle_rad: Array | float) -> Array:
    """Return the same direction in (-pi, pi], shape of the input."""
    wrapped = np.pi - np.mod(np.pi - np.asarray(angle_rad, dtype=np.float64), 2 * np.pi)
    return np.where(wrapped == -np.pi, np.pi, wrapped)  # `mod` may round up to 2 pi


def mean_angle_rad(angles_rad: Array, weights: Array | None = None) -> float:
    """Return the weighted mean direction; NaN where the directions cancel and there is none.

    Args:
        angles_rad: Shape (n,).
        weights: Shape (n,), not negative; equal when None.

    Reference: seed 002, its weighted mean, with atan2.
    """
    weights = _checked_weights(weights, len(angles_rad))
    sine, cosine = weights @ np.sin(angles_rad), weights @ np.cos(angles_rad)
    if np.hypot(sine, cosine) < 1e-12 * weights.sum():
        return float("nan")
    return float(np.arctan2(sine, cosine))


def mean_rotation(rotations: Rotation, weights: Array | None = None) -> Rotation:
    """Return the rotation with the least weighted sum of squared chordal distances.

    Args:
        rotations: n rotations.
        weights: Shape (n,), not negative; equal when None.

    Reference: F. L. Markley et al., Averaging Quaternions, 2007 (as SciPy computes it).
    """
    return rotations.mean(_checked_weights(weights, len(rotations)))


def _checked_weights(weights: Array | None, count: int) -> Array:
    if count == 0:
        raise InputError("a mean needs at least one value, got none")
    checked = np.ones(count) if weights is None else np.asarray(weights, dtype=np.float64)
    if checked.shape != (count,):
        raise InputError(f"expected {count} weights, got an array of shape {checked.shape}")
    if not np.isfinite(checked).all() or (checked < 0).any() or checked.sum() <= 0:
        raise InputError("weights must be finite, not negative, and not all zero")
    return checked

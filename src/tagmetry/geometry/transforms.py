"""Rigid transforms and small changes of them.

`T_a_b` maps coordinates in b to coordinates in a: `p_a = T_a_b.apply(p_b)`, and
`T_a_c = T_a_b * T_b_c`, so that neighbouring frames cancel.

A small change of a pose is the 6-vector (translation in metres, rotation vector in radians), both
in frame a and applied on the left: `t <- t + dt`, `R <- Exp(dr) R`. Covariances of poses are over
this vector. The translation part is thus the plain covariance of `T_a_b.translation`.
"""

import numpy as np
from scipy.spatial.transform import RigidTransform, Rotation

from tagmetry.geometry.arrays import Array

__all__ = ["RigidTransform", "Rotation", "cross_matrix", "perturb_pose", "pose_difference"]


def perturb_pose(T_a_b: RigidTransform, change: Array) -> RigidTransform:
    """Return the pose after a small change.

    Args:
        T_a_b: One pose, or N.
        change: Shape (..., 6): metres and radians in frame a.
    """
    moved = np.asarray(T_a_b.translation) + change[..., :3]
    turned = Rotation.from_rotvec(change[..., 3:]) * T_a_b.rotation
    return RigidTransform.from_components(moved, turned)


def pose_difference(T_a_c: RigidTransform, T_a_b: RigidTransform) -> Array:
    """Return the change that leads from pose `T_a_b` to pose `T_a_c`, shape (..., 6).

    It is the inverse of `perturb_pose`: metres and radians in frame a.
    """
    moved = np.asarray(T_a_c.translation) - np.asarray(T_a_b.translation)
    turned = (T_a_c.rotation * T_a_b.rotation.inv()).as_rotvec()
    return np.concatenate([moved, turned], axis=-1)


def cross_matrix(v: Array) -> Array:
    """Return the matrix of the cross product, `cross_matrix(v) @ w = v x w`, shape (..., 3, 3)."""
    x, y, z = np.moveaxis(np.asarray(v, dtype=np.float64), -1, 0)
    zero = np.zeros_like(x)
    rows = [[zero, -z, y], [z, zero, -x], [-y, x, zero]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)

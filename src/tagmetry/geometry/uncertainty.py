"""A pose that knows how uncertain it is, and the first-order rules for chaining such poses.

With the change of a pose written as (dt, dr) on the left in its frame a (see `transforms`):

    composition   dt_ac = dt_ab + dr_ab x (R_ab t_bc) + R_ab dt_bc,   dr_ac = dr_ab + R_ab dr_bc
    inversion     dt_ba = -R_ba dt_ab - R_ba [t_ab]x dr_ab,           dr_ba = -R_ba dr_ab
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.geometry.arrays import Array
from tagmetry.geometry.transforms import RigidTransform, cross_matrix


@dataclass(frozen=True)
class UncertainTransform:
    """A rigid transform with its covariance.

    Attributes:
        T_a_b: The pose of frame b in frame a.
        covariance: Shape (6, 6), (translation, rotation vector) on the left in frame a, m and rad.
    """

    T_a_b: RigidTransform
    covariance: Array

    @classmethod
    def exact(cls, T_a_b: RigidTransform) -> Self:
        """Return the transform with a covariance of zero."""
        return cls(T_a_b, np.zeros((6, 6)))

    def __matmul__(self, other: "UncertainTransform") -> "UncertainTransform":
        """Chain two poses whose errors are independent: `T_a_c = T_a_b @ T_b_c`."""
        R_a_b = self.T_a_b.rotation.as_matrix()
        arm_a = R_a_b @ other.T_a_b.translation
        by_first = _blocks(np.eye(3), -cross_matrix(arm_a), np.eye(3))
        by_second = _blocks(R_a_b, np.zeros((3, 3)), R_a_b)
        covariance = _carry(by_first, self.covariance) + _carry(by_second, other.covariance)
        return UncertainTransform(self.T_a_b * other.T_a_b, covariance)

    def inverse(self) -> "UncertainTransform":
        """Return the pose of frame a in frame b."""
        R_b_a = self.T_a_b.rotation.as_matrix().T
        by_pose = -_blocks(R_b_a, R_b_a @ cross_matrix(self.T_a_b.translation), R_b_a)
        return UncertainTransform(self.T_a_b.inv(), _carry(by_pose, self.covariance))

    def apply(self, p_b: Array, covariance_b: Array | None = None) -> tuple[Array, Array]:
        """Map a point and say how uncertain it is in frame a.

        Args:
            p_b: The point, shape (3,), metres.
            covariance_b: Its own covariance, shape (3, 3), m^2; exact when None.

        Returns:
            The point in frame a, shape (3,), and its covariance, shape (3, 3), m^2.
        """
        R_a_b = self.T_a_b.rotation.as_matrix()
        by_pose = np.hstack([np.eye(3), -cross_matrix(R_a_b @ p_b)])
        covariance_a = _carry(by_pose, self.covariance)
        if covariance_b is not None:
            covariance_a = covariance_a + _carry(R_a_b, covariance_b)
        return self.T_a_b.apply(p_b), covariance_a


def mahalanobis_squared(error: Array, covariance: Array) -> Array:
    """Return `error^T covariance^-1 error`, shape (...).

    Its mean over many trials is the number of dimensions when the covariance is right.

    Args:
        error: Shape (..., n).
        covariance: Shape (..., n, n), positive definite.
    """
    whitened = np.linalg.solve(covariance, error[..., None])
    return np.asarray(np.einsum("...i,...i->...", error, whitened[..., 0]))


def _blocks(of_dt: Array, dt_of_dr: Array, of_dr: Array) -> Array:
    return np.block([[of_dt, dt_of_dr], [np.zeros((3, 3)), of_dr]])


def _carry(jacobian: Array, covariance: Array) -> Array:
    return np.asarray(jacobian @ covariance @ jacobian.T)

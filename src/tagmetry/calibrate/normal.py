"""The normal equations of a calibration, with every view's pose eliminated (Schur complement).

The unknowns of a view meet those of another only through what all views share: the free
intrinsics and, where it is released, the board's shape. With V the 6x6 block of a view's pose, U
that of the shared numbers and W between them,

    (U - sum W V^-1 W^T) shared = g - sum W V^-1 g_pose

is all that is left to solve. Reference: B. Triggs et al., Bundle Adjustment, 2000, section 6.1.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.bundle import Freedom, Linear
from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Normal:
    """J^T W J and J^T W e in blocks, for m shared numbers and n views.

    The shared numbers are the free intrinsics, then x y z of every point where they are free.

    Attributes:
        U: Of the shared numbers, shape (m, m).
        W: Between shared numbers and poses, shape (n, m, 6).
        V: Of each pose, shape (n, 6, 6).
        g: Of the shared numbers, view by view, shape (n, m).
        g_pose: Shape (n, 6).
    """

    U: Array
    W: Array
    V: Array
    g: Array
    g_pose: Array

    def damped(self, factor: float) -> "Normal":
        """Return it with the diagonals grown by a share, as Marquardt does."""
        V = self.V + factor * np.einsum("nii->ni", self.V)[:, :, None] * np.eye(6)
        return replace(self, U=self.U + factor * np.diag(np.diag(self.U)), V=V)

    def with_prior(self, information: Array, pull: Array) -> "Normal":
        """Return it with what is known of the shared numbers beforehand, both of shape (m,)."""
        g = self.g + pull / len(self.g)
        return replace(self, U=self.U + np.diag(information), g=g)


def normal_equations(linear: Linear, freedom: Freedom) -> Normal:
    """Return the blocks.

    Args:
        linear: Errors and Jacobians, in standard deviations.
        freedom: What is free.
    """
    n, k = linear.error.shape[:2]
    error = linear.error.reshape(n, 2 * k, 1)
    by_pose = linear.by_pose.reshape(n, 2 * k, 6)
    by_intrinsics = linear.by_intrinsics.reshape(n, 2 * k, freedom.count)
    turned, pose = np.swapaxes(by_intrinsics, 1, 2), np.swapaxes(by_pose, 1, 2)
    normal = Normal(
        (turned @ by_intrinsics).sum(axis=0),
        turned @ by_pose,
        pose @ by_pose,
        (turned @ error)[..., 0],
        (pose @ error)[..., 0],
    )
    return normal if freedom.shape_sd_m is None else _with_points(normal, linear)


def eliminate_poses(normal: Normal) -> tuple[Array, Array]:
    """Return the shared numbers' own information (m, m) and gradient (m,)."""
    carried = np.linalg.solve(normal.V, np.swapaxes(normal.W, 1, 2))
    information = normal.U - np.tensordot(normal.W, carried, axes=([0, 2], [0, 1]))
    gradient = normal.g - np.einsum("nim,ni->nm", carried, normal.g_pose)
    return information, gradient.sum(axis=0)


def pose_changes(normal: Normal, shared: Array) -> Array:
    """Return the poses' changes (n, 6) that go with a change of the shared numbers (m,)."""
    rest = normal.g_pose - np.einsum("nmi,m->ni", normal.W, shared)
    return np.asarray(np.linalg.solve(normal.V, rest[..., None])[..., 0])


def _with_points(normal: Normal, linear: Linear) -> Normal:
    """Return the blocks with the points' own; each corner knows of one point only."""
    n, k = linear.error.shape[:2]
    c = normal.W.shape[1]
    turned = np.swapaxes(linear.by_point, 2, 3)
    with_pose = (turned @ linear.by_pose).reshape(n, 3 * k, 6)
    gradient = (turned @ linear.error[..., None]).reshape(n, 3 * k)
    across = (turned @ linear.by_intrinsics).sum(axis=0).reshape(3 * k, c)
    own = np.zeros((k, 3, k, 3))
    own[range(k), :, range(k)] = (turned @ linear.by_point).sum(axis=0)
    U = np.block([[normal.U, across.T], [across, own.reshape(3 * k, 3 * k)]])
    W = np.concatenate([normal.W, with_pose], axis=1)
    return replace(normal, U=U, W=W, g=np.concatenate([normal.g, gradient], axis=1))

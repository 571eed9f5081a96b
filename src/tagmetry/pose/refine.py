"""Maximum-likelihood refinement of poses on the distorted pixels themselves.

Minimises r^T C^-1 r with r the differences between projected and seen corners and C their
covariance, by Levenberg and Marquardt's method over the pose's change (translation, rotation
vector) on the left in the camera frame. Works on a stack of independent poses at once.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray
from tagmetry.geometry.transforms import Rotation, cross_matrix


@dataclass(frozen=True)
class Sightings:
    """What was seen of n bodies, k points each.

    Attributes:
        p_body: The points in the body's frame, shape (n, k, 3), metres.
        pixels: Where they were seen, shape (n, k, 2).
        whitening: W with W C W^T = I, shape (n, 2k, 2k), 1 / px.
    """

    p_body: Array
    pixels: Array
    whitening: Array


@dataclass(frozen=True)
class Poses:
    """n poses: `p_camera = R_camera_body @ p_body + t_camera_body`.

    Attributes:
        R_camera_body: Shape (n, 3, 3).
        t_camera_body: Shape (n, 3), metres.
    """

    R_camera_body: Array
    t_camera_body: Array

    def transform(self, n: int) -> RigidTransform:
        """Return one of the poses."""
        rotation = Rotation.from_matrix(self.R_camera_body[n])
        return RigidTransform.from_components(self.t_camera_body[n], rotation)

    def moved(self, change: Array) -> "Poses":
        """Return the poses after small changes, shape (n, 6)."""
        turn = Rotation.from_rotvec(change[:, 3:]).as_matrix()
        return Poses(turn @ self.R_camera_body, self.t_camera_body + change[:, :3])

    def where(self, condition: BoolArray, other: "Poses") -> "Poses":
        """Return these poses where the condition (n,) holds, else the others."""
        R = np.where(condition[:, None, None], self.R_camera_body, other.R_camera_body)
        return Poses(R, np.where(condition[:, None], self.t_camera_body, other.t_camera_body))

    def points(self, p_body: Array) -> Array:
        """Return points (n, k, 3) in the camera frame."""
        turned = p_body @ np.swapaxes(self.R_camera_body, 1, 2)
        return np.asarray(turned + self.t_camera_body[:, None])


def refine(
    start: Poses, seen: Sightings, camera: Camera, max_iterations: int = 50
) -> tuple[Poses, Array]:
    """Return the poses that fit best and their chi2, shape (n,).

    A pose whose points do not all project (behind the camera, beyond the lens) has chi2 infinite
    and stays where it is.
    """
    poses, chi2 = start, _chi2(start, seen, camera)
    damping = np.full(len(chi2), 1e-3)
    active = np.isfinite(chi2)
    for _ in range(max_iterations):
        if not active.any():
            break
        change = _step(poses, seen, camera, damping)
        tried = poses.moved(np.where(active[:, None], change, 0.0))
        tried_chi2 = _chi2(tried, seen, camera)
        better = active & (tried_chi2 <= chi2)
        settled = np.abs(chi2 - tried_chi2) <= 1e-10 * (1 + chi2)
        poses, chi2 = tried.where(better, poses), np.where(better, tried_chi2, chi2)
        damping = np.where(better, damping / 10, damping * 10)
        active &= ~settled & (damping < 1e12)
    return poses, chi2


def covariances(poses: Poses, seen: Sightings, camera: Camera) -> Array:
    """Return (J^T C^-1 J)^-1, shape (n, 6, 6), m and rad, on the left in the camera frame."""
    J, _ = _whitened(poses, seen, camera)
    return _inverse(np.swapaxes(J, 1, 2) @ J)


def residuals_px(poses: Poses, seen: Sightings, camera: Camera) -> Array:
    """Return projected minus seen, shape (n, k, 2)."""
    return camera.project(poses.points(seen.p_body)) - seen.pixels


def _chi2(poses: Poses, seen: Sightings, camera: Camera) -> Array:
    error = residuals_px(poses, seen, camera).reshape(len(seen.pixels), -1, 1)
    with np.errstate(over="ignore", invalid="ignore"):
        chi2 = ((seen.whitening @ error) ** 2).sum(axis=(1, 2))
    return np.where(np.isfinite(chi2), chi2, np.inf)


def _step(poses: Poses, seen: Sightings, camera: Camera, damping: Array) -> Array:
    J, error = _whitened(poses, seen, camera)
    information = np.swapaxes(J, 1, 2) @ J
    diagonal = np.einsum("nii->ni", information)
    damped = information + (damping[:, None] * diagonal)[:, :, None] * np.eye(6)
    change = -(_inverse(damped) @ (np.swapaxes(J, 1, 2) @ error))[..., 0]
    return np.where(np.isfinite(change).all(axis=1, keepdims=True), change, 0.0)


def _whitened(poses: Poses, seen: Sightings, camera: Camera) -> tuple[Array, Array]:
    """Return the whitened Jacobian, shape (n, 2k, 6), and residuals, shape (n, 2k, 1)."""
    arms = seen.p_body @ np.swapaxes(poses.R_camera_body, 1, 2)
    pixels, by_point = camera.project_with_jacobian(arms + poses.t_camera_body[:, None])
    by_pose = np.concatenate([by_point, -by_point @ cross_matrix(arms)], axis=-1)
    n = len(arms)
    error = (pixels - seen.pixels).reshape(n, -1, 1)
    return seen.whitening @ by_pose.reshape(n, -1, 6), seen.whitening @ error


def _inverse(information: Array) -> Array:
    """Invert positive matrices after scaling their diagonals to one; NaN for singular ones."""
    scale = np.sqrt(np.einsum("nii->ni", information))
    usable = np.isfinite(information).all(axis=(1, 2)) & (scale > 0).all(axis=1)
    scale = np.where(usable[:, None], scale, 1.0)
    scaled = np.where(usable[:, None, None], information, np.eye(6))
    scaled = scaled / scale[:, :, None] / scale[:, None, :]
    usable &= np.linalg.cond(scaled) < 1e13
    inverse = np.linalg.inv(np.where(usable[:, None, None], scaled, np.eye(6)))
    inverse = inverse / scale[:, :, None] / scale[:, None, :]
    return np.where(usable[:, None, None], inverse, np.nan)

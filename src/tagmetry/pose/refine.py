"""Maximum-likelihood refinement of poses on the distorted pixels themselves.

Minimises r^T C^-1 r with r the differences between projected and seen corners and C their
covariance, by Levenberg and Marquardt's method over the pose's change (translation, rotation
vector) on the left in the camera frame. Works on a stack of independent poses at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.transforms import cross_matrix
from tagmetry.pose.stacks import Poses, Rows, Sightings

_SETTLED = 1e-10  # chi2 changes by less than this share: a hundred-thousandth of a deviation


@dataclass(frozen=True)
class Fit:
    """How n poses fit what was seen.

    Attributes:
        poses: The poses.
        J: d(whitened residuals) / d(change of the pose), shape (n, 2k, 6).
        error: Whitened residuals, shape (n, 2k, 1).
        chi2: Their squared sum, shape (n,); infinite where a point does not project.
    """

    poses: Poses
    J: Array
    error: Array
    chi2: Array

    def __getitem__(self, chosen: Rows) -> "Fit":
        """Return some of the fits."""
        return Fit(self.poses[chosen], self.J[chosen], self.error[chosen], self.chi2[chosen])

    @property
    def covariances(self) -> Array:
        """(J^T C^-1 J)^-1, shape (n, 6, 6), m and rad, on the left in the camera frame."""
        return _inverse(np.swapaxes(self.J, 1, 2) @ self.J)

    def deviations_to(self, other: "Fit") -> Array:
        """Return how many standard deviations of this fit lie between the poses, shape (n,)."""
        change = self.poses.change_to(other.poses)[..., None]
        with np.errstate(invalid="ignore", over="ignore"):
            return np.asarray(np.linalg.norm(self.J @ change, axis=(1, 2)))


def refine(start: Poses, seen: Sightings, camera: Camera, max_iterations: int = 50) -> Fit:
    """Return the poses that fit best.

    A pose whose points do not all project (behind the camera, beyond the lens) has chi2 infinite
    and stays where it is.
    """
    fit = _fit(start, seen, camera)
    damping = np.full(len(fit.chi2), 1e-3)
    rest = np.flatnonzero(np.isfinite(fit.chi2))
    for _ in range(max_iterations):
        if not rest.size:
            break
        now = fit[rest]
        tried = _fit(now.poses.moved(_step(now, damping[rest])), seen[rest], camera)
        better = tried.chi2 <= now.chi2
        settled = np.abs(now.chi2 - tried.chi2) <= _SETTLED * (1 + now.chi2)
        fit = _updated(fit, rest[better], tried[better])
        damping[rest] *= np.where(better, 0.1, 10.0)
        rest = rest[~settled & (damping[rest] < 1e12)]
    return fit


def residuals_px(poses: Poses, seen: Sightings, camera: Camera) -> Array:
    """Return projected minus seen, shape (n, k, 2)."""
    return camera.project(poses.points(seen.p_body)) - seen.pixels


def joined(fits: Sequence[Fit]) -> Fit:
    """Return several fits of the same points as one."""
    R = np.concatenate([fit.poses.R_camera_body for fit in fits])
    t = np.concatenate([fit.poses.t_camera_body for fit in fits])
    parts = ([fit.J for fit in fits], [fit.error for fit in fits], [fit.chi2 for fit in fits])
    return Fit(Poses(R, t), *(np.concatenate(part) for part in parts))


def _fit(poses: Poses, seen: Sightings, camera: Camera) -> Fit:
    arms = seen.p_body @ np.swapaxes(poses.R_camera_body, 1, 2)
    pixels, by_point = camera.project_with_jacobian(arms + poses.t_camera_body[:, None])
    by_pose = np.concatenate([by_point, -by_point @ cross_matrix(arms)], axis=-1)
    J = seen.whitening @ by_pose.reshape(len(arms), -1, 6)
    error = seen.whitening @ (pixels - seen.pixels).reshape(len(arms), -1, 1)
    with np.errstate(over="ignore", invalid="ignore"):
        chi2 = (error**2).sum(axis=(1, 2))
    return Fit(poses, J, error, np.where(np.isfinite(chi2), chi2, np.inf))


def _updated(fit: Fit, rows: Rows, new: Fit) -> Fit:
    """Return the fits with some of them replaced."""
    return Fit(
        Poses(
            _put(fit.poses.R_camera_body, rows, new.poses.R_camera_body),
            _put(fit.poses.t_camera_body, rows, new.poses.t_camera_body),
        ),
        _put(fit.J, rows, new.J),
        _put(fit.error, rows, new.error),
        _put(fit.chi2, rows, new.chi2),
    )


def _put(array: Array, rows: Rows, new: Array) -> Array:
    changed = array.copy()
    changed[rows] = new
    return changed


def _step(fit: Fit, damping: Array) -> Array:
    """Return Levenberg and Marquardt's change of each pose (n, 6); zero where there is none."""
    J_transposed = np.swapaxes(fit.J, 1, 2)
    information = J_transposed @ fit.J
    diagonal = np.einsum("nii->ni", information)
    damped = information + (damping[:, None] * diagonal)[:, :, None] * np.eye(6)
    change = -(_inverse(damped) @ (J_transposed @ fit.error))[..., 0]
    return np.where(np.isfinite(change).all(axis=1, keepdims=True), change, 0.0)


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

"""Maximum-likelihood refinement of poses on the distorted pixels themselves.

Minimises r^T C^-1 r with r the differences between projected and seen corners and C their
covariance, by Levenberg and Marquardt's method over the pose's change (translation, rotation
vector) on the left in the camera frame. Works on a stack of independent poses at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray
from tagmetry.geometry.transforms import Rotation, cross_matrix

Rows = slice | BoolArray | NDArray[np.intp]

_SETTLED = 1e-10  # chi2 changes by less than this share: a hundred-thousandth of a deviation


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

    def __getitem__(self, chosen: Rows) -> "Sightings":
        """Return some of the sightings."""
        return Sightings(self.p_body[chosen], self.pixels[chosen], self.whitening[chosen])

    def repeated(self, times: int) -> "Sightings":
        """Return every sighting several times in a row."""
        parts = (self.p_body, self.pixels, self.whitening)
        return Sightings(*(np.repeat(part, times, axis=0) for part in parts))


@dataclass(frozen=True)
class Poses:
    """n poses: `p_camera = R_camera_body @ p_body + t_camera_body`.

    Attributes:
        R_camera_body: Shape (n, 3, 3).
        t_camera_body: Shape (n, 3), metres.
    """

    R_camera_body: Array
    t_camera_body: Array

    def __getitem__(self, chosen: Rows) -> "Poses":
        """Return some of the poses."""
        return Poses(self.R_camera_body[chosen], self.t_camera_body[chosen])

    @classmethod
    def of(cls, Ts_camera_body: RigidTransform) -> "Poses":
        """Return n rigid transforms as plain arrays."""
        return cls(Ts_camera_body.rotation.as_matrix(), np.asarray(Ts_camera_body.translation))

    def turns_rad(self, other: "Poses") -> Array:
        """Return the angles between these n rotations and others (n or 1), shape (n,)."""
        chord = np.linalg.norm(self.R_camera_body - other.R_camera_body, axis=(1, 2))
        return np.asarray(2 * np.arcsin(np.minimum(chord / np.sqrt(8), 1.0)))

    def transforms(self) -> RigidTransform:
        """Return the n poses as rigid transforms."""
        rotations = Rotation.from_matrix(self.R_camera_body)
        return RigidTransform.from_components(self.t_camera_body, rotations)

    def moved(self, change: Array) -> "Poses":
        """Return the poses after small changes, shape (n, 6)."""
        turn = Rotation.from_rotvec(change[:, 3:]).as_matrix()
        return Poses(turn @ self.R_camera_body, self.t_camera_body + change[:, :3])

    def change_to(self, other: "Poses") -> Array:
        """Return the changes that lead to other poses, shape (n, 6): the inverse of `moved`."""
        turn = Rotation.from_matrix(other.R_camera_body @ np.swapaxes(self.R_camera_body, 1, 2))
        return np.hstack([other.t_camera_body - self.t_camera_body, turn.as_rotvec()])

    def points(self, p_body: Array) -> Array:
        """Return points (n, k, 3) in the camera frame."""
        turned = p_body @ np.swapaxes(self.R_camera_body, 1, 2)
        return np.asarray(turned + self.t_camera_body[:, None])


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


def joined(fits: Sequence[Fit]) -> Fit:
    """Return several fits of the same points as one."""
    R = np.concatenate([fit.poses.R_camera_body for fit in fits])
    t = np.concatenate([fit.poses.t_camera_body for fit in fits])
    parts = ([fit.J for fit in fits], [fit.error for fit in fits], [fit.chi2 for fit in fits])
    return Fit(Poses(R, t), *(np.concatenate(part) for part in parts))


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

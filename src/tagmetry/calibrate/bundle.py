"""What a calibration solves for, how far it may move, and how the predictions follow.

Frames: p_camera = R_camera_board p_board + t_camera_board. A pose changes by (dt, dr) on the
left: t <- t + dt, R <- Exp(dr) R.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np
from scipy.spatial.transform import Rotation

from tagmetry.calibrate.sightings import Sightings
from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray


@dataclass(frozen=True, eq=False)
class Bundle:
    """A camera, the board's poses, and the board's points.

    Attributes:
        kind: Which lens.
        intrinsics: fx, fy, cx, cy and the coefficients, shape (4 + c,).
        R_camera_board: Shape (n, 3, 3).
        t_camera_board: Shape (n, 3), metres.
        p_board: Shape (k, 3), metres.
    """

    kind: Literal["brown", "fisheye"]
    intrinsics: Array
    R_camera_board: Array
    t_camera_board: Array
    p_board: Array

    @cached_property
    def lens(self) -> Lens:
        """The lens."""
        coefficients = tuple(float(c) for c in self.intrinsics[4:])
        return FisheyeLens(coefficients) if self.kind == "fisheye" else BrownLens(coefficients)

    def camera(self, size_px: tuple[int, int]) -> Camera:
        """Return the camera."""
        fx, fy, cx, cy = (float(value) for value in self.intrinsics[:4])
        return Camera(*size_px, (fx, fy), (cx, cy), self.lens)

    @property
    def is_possible(self) -> bool:
        """Whether it is a camera at all."""
        return bool(np.isfinite(self.intrinsics).all() and (self.intrinsics[:2] > 0).all())

    def only(self, views: IntArray | BoolArray) -> "Bundle":
        """Return it with some of the views."""
        R, t = self.R_camera_board[views], self.t_camera_board[views]
        return replace(self, R_camera_board=R, t_camera_board=t)

    def arms(self) -> Array:
        """Return the board's points turned into the camera frame, shape (n, k, 3), metres."""
        return np.asarray(self.p_board @ np.swapaxes(self.R_camera_board, 1, 2))

    def predict(self) -> Array:
        """Return the pixels of every point in every view, shape (n, k, 2); NaN where unseen."""
        bent = self.lens.bend(self.arms() + self.t_camera_board[:, None])
        return np.asarray(bent * self.intrinsics[:2] + self.intrinsics[2:4])

    def moved(self, by_intrinsics: Array, by_poses: Array, by_points: Array) -> "Bundle":
        """Return it after changes of shape (4 + c,), (n, 6) and (k, 3)."""
        turn = Rotation.from_rotvec(by_poses[:, 3:]).as_matrix()
        return replace(
            self,
            intrinsics=self.intrinsics + by_intrinsics,
            R_camera_board=turn @ self.R_camera_board,
            t_camera_board=self.t_camera_board + by_poses[:, :3],
            p_board=self.p_board + by_points,
        )


@dataclass(frozen=True, eq=False)
class Freedom:
    """What may change.

    Attributes:
        basis: The intrinsics move by `basis @ change`, shape (4 + c, free); none is free: (.., 0).
        shape_sd_m: How far along each axis the board's points may be from the maker's places (one
            standard deviation), shape (3,), metres; None: they may not move.
    """

    basis: Array
    shape_sd_m: Array | None = None

    @property
    def count(self) -> int:
        """How many numbers of the camera are free."""
        return int(self.basis.shape[1])


@dataclass(frozen=True, eq=False)
class Linear:
    """Errors and Jacobians of the predictions at one place, in standard deviations of corners.

    Attributes:
        error: Seen minus predicted, shape (n, k, 2); zero where a corner does not count.
        by_intrinsics: Over the free intrinsics, shape (n, k, 2, free).
        by_pose: Shape (n, k, 2, 6).
        by_point: Over the corner's own point, shape (n, k, 2, 3); (n, k, 2, 0) where it is held.
    """

    error: Array
    by_intrinsics: Array
    by_pose: Array
    by_point: Array

    def only(self, views: IntArray | BoolArray | slice) -> "Linear":
        """Return some of the views."""
        parts = (self.error, self.by_intrinsics, self.by_pose, self.by_point)
        return Linear(*(part[views] for part in parts))


def errors_px(bundle: Bundle, seen: Sightings) -> Array:
    """Return seen minus predicted, shape (n, k, 2), zero where a corner does not count."""
    return np.where(seen.used[..., None], seen.corners_px - bundle.predict(), 0.0)


def errors_in_sd(bundle: Bundle, seen: Sightings) -> Array:
    """Return the same in standard deviations, errors of independent axes."""
    return seen.whiten(errors_px(bundle, seen))


def linearise(bundle: Bundle, seen: Sightings, freedom: Freedom) -> Linear:
    """Return the errors and their analytic Jacobians."""
    arms = bundle.arms()
    p_camera = arms + bundle.t_camera_board[:, None]
    bent = bundle.lens.bend(p_camera)
    by_p_camera, by_coefficients = bundle.lens.jacobians(p_camera)
    by_p_camera *= bundle.intrinsics[:2, None]
    predicted = bent * bundle.intrinsics[:2] + bundle.intrinsics[2:4]
    parts = (
        seen.corners_px - predicted,
        _by_free(bundle, bent, by_coefficients, freedom),
        _by_pose(arms, by_p_camera),
        _by_point(by_p_camera, bundle.R_camera_board, freedom),
    )
    return Linear(*(seen.whiten(_where_used(part, seen.used)) for part in parts))


def _by_free(bundle: Bundle, bent: Array, by_coefficients: Array, freedom: Freedom) -> Array:
    """Return d(pixel) / d(free intrinsics), shape (n, k, 2, free)."""
    by_intrinsics = np.zeros((*bent.shape, len(bundle.intrinsics)))
    for axis in range(2):
        by_intrinsics[..., axis, axis] = bent[..., axis]
        by_intrinsics[..., axis, 2 + axis] = 1
        by_intrinsics[..., axis, 4:] = by_coefficients[..., axis, :] * bundle.intrinsics[axis]
    flat = by_intrinsics.reshape(-1, len(bundle.intrinsics)) @ freedom.basis
    return np.asarray(flat.reshape(*bent.shape, freedom.count))


def _by_pose(arms: Array, by_p_camera: Array) -> Array:
    """Return d(pixel) / d(dt, dr), shape (n, k, 2, 6): a turn moves a point by dr x arm."""
    by_pose = np.empty((*by_p_camera.shape[:-1], 6))
    by_pose[..., :3] = by_p_camera
    for axis in range(3):
        after, last = (axis + 1) % 3, (axis + 2) % 3
        by_pose[..., 3 + axis] = (
            arms[:, :, None, after] * by_p_camera[..., last]
            - arms[:, :, None, last] * by_p_camera[..., after]
        )
    return by_pose


def _by_point(by_p_camera: Array, R_camera_board: Array, freedom: Freedom) -> Array:
    """Return d(pixel) / d(board point), shape (n, k, 2, 3); none where points are held."""
    if freedom.shape_sd_m is None:
        return by_p_camera[..., :0]
    flat = by_p_camera.reshape(len(R_camera_board), -1, 3) @ R_camera_board
    return np.asarray(flat.reshape(by_p_camera.shape))


def _where_used(part: Array, used: BoolArray) -> Array:
    """Return (n, k, ...) with zeros where a corner does not count."""
    if used.all():
        return part
    return np.where(used.reshape(*used.shape, *(1,) * (part.ndim - 2)), part, 0.0)

"""What is known of a camera so far, and what one more view of the board would add.

Knowledge is information: the inverse covariance of the free intrinsics. A view adds its own,
J^T W J with its pose eliminated, so that its worth can be told before it is taken.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.bundle import Bundle, Freedom
from tagmetry.calibrate.homographies import fit_homographies
from tagmetry.calibrate.quality.motion import ImpliedMotion, implied_motion
from tagmetry.calibrate.quality.projection import at_pixels, image_grid, motion_of_views
from tagmetry.calibrate.quality.solved import (
    Solved,
    freedom_of,
    honest_covariance,
    view_informations,
)
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.sightings import Sightings, gather
from tagmetry.calibrate.view import BoardView
from tagmetry.calibrate.zhang import poses_from_homographies
from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_GRID = (9, 7)
_FIELD_OF_VIEW_DEG = 60.0  # of a camera nobody knows: a webcam, a telephone
_FOCAL_SHARE, _ASPECT_SHARE, _CENTER_SHARE = 0.3, 0.01, 0.05
_LENS_SD = np.array([0.3, 0.3, 0.005, 0.005])
_CORNER_SD_PX = 0.15


@dataclass(frozen=True, eq=False)
class Knowledge:
    """What is known of a camera.

    Attributes:
        camera: The best guess.
        freedom: Which of its numbers are to be found out.
        information: Of these, shape (free, free).
        to_pixels: What they do to a grid over the image, the camera's implied motion made up for,
            shape (g, 2, free); only where the lens shows something.
        variance: Of a new view's corners, in units of their own sd^2.
        corner_sd_px: What a new view's corners are likely to have.
    """

    camera: Camera
    freedom: Freedom
    information: Array
    to_pixels: Array
    variance: float
    corner_sd_px: float

    @classmethod
    def of_calibration(cls, calibration: Calibration) -> "Knowledge":
        """Return what a calibration tells.

        Its shape is the formula's: which directions are weak. Its size allows for errors that
        depend on each other, by the mean ratio of the camera's covariance to the formula's; the
        covariance itself is too noisy while views are few.
        """
        solved = Solved.of(calibration)
        freedom = freedom_of(calibration.formula_covariance)
        to_free = np.linalg.pinv(freedom.basis)
        covariance = to_free @ honest_covariance(calibration) @ to_free.T
        by_formula = to_free @ calibration.formula_covariance @ to_free.T
        dependence = np.trace(np.linalg.solve(by_formula, covariance)) / freedom.count
        dependence = max(float(dependence), 1.0)
        return cls(
            calibration.camera,
            freedom,
            np.asarray(np.linalg.inv(by_formula) / dependence),
            _to_pixels(motion_of_views(calibration), freedom),
            solved.variance * dependence,
            float(np.median(1 / np.sqrt(solved.seen.weights[solved.seen.used]))),
        )

    @classmethod
    def rough(cls, size_px: tuple[int, int], corner_sd_px: float = _CORNER_SD_PX) -> "Knowledge":
        """Return what is known of any camera with pictures of this size."""
        camera = rough_camera(size_px)
        covariance = camera.covariance if camera.covariance is not None else np.zeros((8, 8))
        freedom = freedom_of(covariance)
        to_free = np.linalg.pinv(freedom.basis)
        information = np.linalg.inv(to_free @ covariance @ to_free.T)
        everywhere = camera.unproject(image_grid(camera, *_GRID)).reshape(-1, 3)
        to_pixels = _to_pixels(implied_motion(camera, everywhere), freedom)
        return cls(camera, freedom, information, to_pixels, 1.0, corner_sd_px)

    @property
    def worst_px(self) -> float:
        """The largest standard deviation of projections over the image."""
        return float(self.worst_with_px(np.zeros_like(self.information)[None])[0])

    def worst_with_px(self, informations: Array) -> Array:
        """Return what it would be with one more view each, shape (n,).

        Args:
            informations: Of the views, shape (n, free, free).
        """
        covariances = np.linalg.inv(self.information + informations)[:, None]
        carried = self.to_pixels @ covariances @ np.swapaxes(self.to_pixels, 1, 2)
        return np.asarray(np.sqrt(np.linalg.eigvalsh(carried)[..., 1].max(axis=1)))

    def of_views(self, bundle: Bundle, seen: Sightings) -> Array:
        """Return what views at given poses would tell, shape (n, free, free)."""
        return view_informations(bundle, seen, self.freedom) / self.variance

    def with_views(self, views: Sequence[BoardView]) -> "Knowledge":
        """Return what is known after views, each at the pose that fits this camera."""
        if not views:
            return self
        seen = gather(views)
        told = self.of_views(bundle_of(self.camera, seen), seen)
        usable = np.isfinite(told).all(axis=(1, 2))
        return replace(self, information=self.information + told[usable].sum(axis=0))


def rough_camera(size_px: tuple[int, int]) -> Camera:
    """Return a camera with 60 degrees of view, and a covariance that holds for most cameras."""
    width, height = size_px
    focal = width / 2 / np.tan(np.radians(_FIELD_OF_VIEW_DEG) / 2)
    sd = np.concatenate([[focal * _ASPECT_SHARE] * 2, [width * _CENTER_SHARE] * 2, _LENS_SD])
    covariance = np.diag(sd**2)
    covariance[:2, :2] += (focal * _FOCAL_SHARE) ** 2
    lens = BrownLens((0.0,) * len(_LENS_SD))
    center = ((width - 1) / 2, (height - 1) / 2)
    return Camera(width, height, (focal, focal), center, lens, covariance)


def bundle_of(camera: Camera, seen: Sightings) -> Bundle:
    """Return a camera with the poses of a flat board by homographies of its straightened rays."""
    rays = camera.unproject(seen.corners_px)
    known = np.isfinite(rays).all(axis=-1) & (rays[..., 2] > 0)
    straight = np.where(
        known[..., None], rays[..., :2] / np.where(known, rays[..., 2], 1)[..., None], 0
    )
    H = fit_homographies(seen.p_board[:, :2], straight, seen.weights * known)
    R, t = poses_from_homographies(np.eye(3), H)
    return bundle_at(camera, R, t, seen.p_board)


def bundle_at(
    camera: Camera, R_camera_board: Array, t_camera_board: Array, p_board: Array
) -> Bundle:
    """Return a camera with boards at poses."""
    intrinsics = np.concatenate([camera.focal_px, camera.center_px, camera.lens.coefficients])
    return Bundle(camera.lens.kind, intrinsics, R_camera_board, t_camera_board, p_board)


def _to_pixels(motion: ImpliedMotion, freedom: Freedom) -> Array:
    """Return d(pixel) / d(free intrinsics) over the image, shape (g, 2, free)."""
    remaining = at_pixels(motion, image_grid(motion.camera, *_GRID)) @ freedom.basis
    remaining = remaining.reshape(-1, 2, freedom.count)
    shown = np.isfinite(remaining).all(axis=(1, 2))
    if not shown.any():
        raise InputError("the camera's lens shows nothing of its own image; calibrate again")
    return np.asarray(remaining[shown])

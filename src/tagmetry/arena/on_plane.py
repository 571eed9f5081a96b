"""Where on a level plane does a pixel look, and how sure is that?

The ray of a pixel meets the plane z = h at a point p. Between pixels and points of that plane

    A = d(pixel) / d(x, y) = J R_camera_world[:, :2]

so that the covariance of p is A^-1 S A^-T for a pixel of covariance S. A camera that is moved by
(dt, dr) and a plane that is higher by dh move the pixel of a point that stays where it is by

    C = J R_camera_world [-1, [p - t]x] and c = J R_camera_world[:, 2].
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform, cross_matrix


@dataclass(frozen=True, eq=False)
class OverheadView:
    """A calibrated camera at its place over the floor.

    Attributes:
        camera: Its intrinsics.
        T_world_camera: Where it is; the world's z is up.
        covariance: Of its pose, shape (6, 6), (translation, rotation vector) on the left in the
            world frame, m and rad.
    """

    camera: Camera
    T_world_camera: RigidTransform
    covariance: Array

    def points_on_plane(self, pixels: Array, height_m: Array | float = 0.0) -> Array:
        """Return where rays meet level planes.

        Args:
            pixels: As the camera gives them, shape (..., 2).
            height_m: Of the plane, shape (...) or one for all.

        Returns:
            World points, shape (..., 3), metres; NaN where the ray misses the plane.
        """
        origin = self.camera_in_world
        rays = self.camera.unproject(pixels) @ self.R_world_camera.T
        with np.errstate(divide="ignore", invalid="ignore"):
            scale = (height_m - origin[2]) / rays[..., 2]
            hits = np.isfinite(scale) & (scale > 0)
        return np.asarray(origin + np.where(hits, scale, np.nan)[..., None] * rays)

    def project(self, p_world: Array) -> tuple[Array, Array]:
        """Return pixels, shape (..., 2), and d(pixel) / d(world point), shape (..., 2, 3)."""
        R_camera_world = self.R_world_camera.T
        p_camera = (p_world - self.T_world_camera.translation) @ R_camera_world.T
        pixels, by_point = self.camera.project_with_jacobian(p_camera)
        return pixels, np.asarray(by_point @ R_camera_world)

    def by_camera(self, p_world: Array, by_point: Array) -> Array:
        """Return d(pixel) / d(camera's pose) of points that stay where they are, (..., 2, 6)."""
        arm = cross_matrix(p_world - self.T_world_camera.translation)
        return np.concatenate([-by_point, by_point @ arm], axis=-1)

    @cached_property
    def R_world_camera(self) -> Array:  # noqa: N802 (a frame's name)
        """How the camera is turned, shape (3, 3)."""
        return np.array(self.T_world_camera.rotation.as_matrix(), dtype=np.float64)

    @cached_property
    def camera_in_world(self) -> Array:
        """Where the camera is, shape (3,), m."""
        return np.array(self.T_world_camera.translation, dtype=np.float64)


def point_on_plane(
    view: OverheadView, pixel: Array, covariance_px2: Array, height_m: float, height_sd_m: float = 0
) -> tuple[Array, Array]:
    """Return where the ray of one pixel meets a level plane, and how sure that is.

    Args:
        view: The camera.
        pixel: Shape (2,).
        covariance_px2: Of the pixel, shape (2, 2).
        height_m: Of the plane.
        height_sd_m: Standard deviation of that.

    Returns:
        (x, y) in the world, shape (2,), NaN where the ray misses the plane; and the covariance,
        shape (2, 2), m^2, from the pixel, the camera's pose and the height.
    """
    p_world = view.points_on_plane(pixel, height_m)
    _, by_point = view.project(p_world)
    to_plane = np.linalg.inv(by_point[:, :2])
    by_camera = to_plane @ view.by_camera(p_world, by_point)
    by_height = to_plane @ by_point[:, 2] * height_sd_m
    covariance = to_plane @ covariance_px2 @ to_plane.T
    covariance = covariance + by_camera @ view.covariance @ by_camera.T
    return p_world[:2], np.asarray(covariance + np.outer(by_height, by_height))

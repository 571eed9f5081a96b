"""What errors of all four corners together do to a marker's pose: calibration, size, uneven blur.

    d(pose) = (J^T C^-1 J)^-1 J^T C^-1 d(pixels)

with J the corners' derivatives by the pose, C their covariance.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform, cross_matrix
from tagmetry.lens.readable import MarkerKind
from tagmetry.lens.setting import LensSetting
from tagmetry.lens.zoom_lens import ZoomLens
from tagmetry.markers import marker_corners_m

# Pixels inward per pixel that a corner's disc is wider than the marker's mean; measured on the
# twin at 0.03 to 0.04 m, turned by 30 and 45 degrees: 0.11 to 0.15.
_INWARD_BY_DISC = 0.13


@dataclass(frozen=True, eq=False)
class CornerErrors:
    """A marker's corners as its pose has them.

    Attributes:
        T_camera_marker: The pose.
        corners_cov_px2: C, shape (8, 8).
        camera: At the setting.
        marker: Its size.
    """

    T_camera_marker: RigidTransform
    corners_cov_px2: Array
    camera: Camera
    marker: MarkerKind

    def of_calibration(self) -> Array:
        """Return what the intrinsics' covariance makes of the pose's, shape (6, 6)."""
        if self.camera.covariance is None:
            return np.zeros((6, 6))
        by_camera = self._gain @ self.camera.parameter_jacobian(self._p_camera).reshape(8, -1)
        return np.asarray(by_camera @ self.camera.covariance @ by_camera.T)

    def of_size(self) -> Array:
        """Return what the size's deviation makes of it, shape (6, 6)."""
        by_point = self._projected[1]
        outward = (self._from_centre / self.marker.size_m)[..., None]
        by_size = self._gain @ (by_point @ outward).reshape(8)
        return np.asarray(self.marker.size_sd_m**2 * np.outer(by_size, by_size))

    def of_uneven_blur(self, lens: ZoomLens, setting: LensSetting) -> Array:
        """Return what a blur makes of it that is not the same at all corners, shape (6, 6).

        A detector fits one blur to the whole marker: corners that are blurred more come out too
        far in, the others too far out. That is one error of a known shape, not four.
        """
        pixels = self._projected[0]
        outward = pixels - pixels.mean(axis=0)
        outward = outward / np.linalg.norm(outward, axis=1, keepdims=True)
        discs_px = np.array([lens.blur_of_depth_px(setting, z) for z in self._p_camera[:, 2]])
        wider_px = discs_px - discs_px.mean()
        by_blur = self._gain @ (_INWARD_BY_DISC * wider_px[:, None] * outward).reshape(8)
        return np.outer(by_blur, by_blur)

    @cached_property
    def _from_centre(self) -> Array:
        corners_m = marker_corners_m(self.marker.size_m)
        return np.asarray(self.T_camera_marker.rotation.apply(corners_m))

    @property
    def _p_camera(self) -> Array:
        return np.asarray(self._from_centre + self.T_camera_marker.translation)

    @cached_property
    def _projected(self) -> tuple[Array, Array]:
        """The corners' pixels, shape (4, 2), and their derivatives by the points, (4, 2, 3)."""
        return self.camera.project_with_jacobian(self._p_camera)

    @cached_property
    def _gain(self) -> Array:
        """The change of the pose for one of the pixels, shape (6, 8)."""
        by_point = self._projected[1]
        turned = np.stack([-cross_matrix(arm) for arm in self._from_centre])
        J = np.concatenate([by_point, by_point @ turned], axis=2).reshape(8, 6)
        weights = np.linalg.inv(self.corners_cov_px2)
        return np.asarray(-np.linalg.solve(J.T @ weights @ J, J.T @ weights))

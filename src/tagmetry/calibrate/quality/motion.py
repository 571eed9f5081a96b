"""The motion of the camera that a change of its intrinsics implies, and what it leaves.

Another principal point and a camera turned a little show nearly the same picture: what a
calibration leaves open of the one, the pose that is measured with it takes up. Of an error d of
the intrinsics only that part does harm which no motion m of the camera, (translation, rotation
vector), makes up for. To first order the pixel of a point p moves by

    J_d(p) d + J_p(p) (m_t + m_r x p)

and the implied motion is the m for which this is least, in the mean square, over the corners that
the calibration saw. What remains at any other pixel is linear in d.

Reference: D. Kogan, mrcal, the documentation of projection uncertainty and of differencing
(implied transformation); here in closed form, from the intrinsics alone.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, cross_matrix


@dataclass(frozen=True, eq=False)
class ImpliedMotion:
    """The motion that goes with a change of the intrinsics.

    Attributes:
        camera: The camera it is a motion of.
        by_intrinsics: d(motion) / d(intrinsics), (translation, rotation vector) in the camera
            frame, shape (6, 4 + c).
    """

    camera: Camera
    by_intrinsics: Array

    def remaining(self, p_camera: Array) -> Array:
        """Return d(pixel) / d(intrinsics) with the motion made up for, shape (..., 2, 4 + c)."""
        by_motion = _by_motion(self.camera, p_camera)
        return np.asarray(self.camera.parameter_jacobian(p_camera) + by_motion @ self.by_intrinsics)


def implied_motion(camera: Camera, p_camera: Array) -> ImpliedMotion:
    """Return the motion that fits best at some points.

    Args:
        camera: The intrinsics around which they change.
        p_camera: The points, shape (n, 3), metres; those the lens does not show are left out.
    """
    by_motion = _by_motion(camera, p_camera)
    shown = np.isfinite(by_motion).all(axis=(1, 2))
    A = by_motion[shown].reshape(-1, 6)
    B = camera.parameter_jacobian(p_camera[shown]).reshape(len(A), -1)
    size = np.maximum(np.linalg.norm(A, axis=0), 1e-12)
    motion = -np.linalg.lstsq(A / size, B, rcond=None)[0] / size[:, None]
    return ImpliedMotion(camera, motion)


def _by_motion(camera: Camera, p_camera: Array) -> Array:
    """Return d(pixel) / d(translation, rotation vector), shape (..., 2, 6)."""
    _, by_point = camera.project_with_jacobian(p_camera)
    return np.concatenate([by_point, -by_point @ cross_matrix(p_camera)], axis=-1)

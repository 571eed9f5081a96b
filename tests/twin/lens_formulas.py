"""Where a camera sees a point: the published formulas, written once more, with matrices.

Nothing of tagmetry's is used but a `Camera`'s numbers; OpenCV is held against it in a test.
"""

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array


def project_px(p_camera: Array, camera: Camera) -> Array:
    """Return the pixels (n, 2) of points (n, 3) in the camera's frame."""
    given = np.asarray(camera.lens.coefficients, dtype=np.float64)
    if camera.lens.kind == "fisheye":
        bent = _fisheye(p_camera, given)
    else:
        bent = _brown(p_camera[:, :2] / p_camera[:, 2:], np.pad(given, (0, 14 - len(given))))
    return np.asarray(bent * camera.focal_px + camera.center_px)


def _fisheye(p_camera: Array, k: Array) -> Array:
    """Kannala and Brandt (2006): the radius is an odd polynomial of the angle off the axis."""
    angle = np.arccos(p_camera[:, 2] / np.linalg.norm(p_camera, axis=1))
    radius = np.polyval([*k[::-1], 1.0], angle**2) * angle
    direction = np.arctan2(p_camera[:, 1], p_camera[:, 0])
    return np.column_stack([radius * np.cos(direction), radius * np.sin(direction)])


def _brown(ray: Array, k: Array) -> Array:
    """Brown (1971), with a rational radial part, thin prisms and a tilted sensor."""
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tilt_x, tilt_y = k
    r2 = np.sum(ray**2, axis=1)
    radial = np.polyval([k3, k2, k1, 1.0], r2) / np.polyval([k6, k5, k4, 1.0], r2)
    both = 2.0 * ray.prod(axis=1)
    prism = np.stack([np.polyval([s2, s1, 0.0], r2), np.polyval([s4, s3, 0.0], r2)], axis=1)
    decentred = np.outer(both, [p1, p2]) + (r2[:, None] + 2.0 * ray**2) * [p2, p1]
    bent = radial[:, None] * ray + decentred + prism
    on_sensor = np.column_stack([bent, np.ones(len(bent))]) @ _sensor_homography(tilt_x, tilt_y).T
    return on_sensor[:, :2] / on_sensor[:, 2:]


def _sensor_homography(tilt_x: float, tilt_y: float) -> Array:
    about_x = np.array(
        [
            [1.0, 0.0, 0.0],
            [0.0, np.cos(tilt_x), np.sin(tilt_x)],
            [0.0, -np.sin(tilt_x), np.cos(tilt_x)],
        ]
    )
    about_y = np.array(
        [
            [np.cos(tilt_y), 0.0, -np.sin(tilt_y)],
            [0.0, 1.0, 0.0],
            [np.sin(tilt_y), 0.0, np.cos(tilt_y)],
        ]
    )
    R = about_y @ about_x
    onto = np.array([[R[2, 2], 0.0, -R[0, 2]], [0.0, R[2, 2], -R[1, 2]], [0.0, 0.0, 1.0]])
    return onto @ R

"""Markers' places as seed 001 has them: OpenCV finds them, and solvePnP gives each one's pose.

    cv2.aruco detectMarkers on the whole image, then a pose for every marker alone

This shares no code with tagmetry's own way.
"""

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.rigs.opencv_corners import opencv_corners
from tagmetry.markers import marker_corners_m


def seen_places(pixels: AnyPixels, camera: Camera, size_m: float) -> dict[int, Array]:
    """Return (x, y, angle) of every marker by its id, in the camera's frame seen from above.

    x is the camera's x, y points against the camera's y, and the angle is that of the marker's top
    from x, so that all is as on a floor below a camera that looks straight down.
    """
    lens = np.array(camera.lens.coefficients)
    found: dict[int, Array] = {}
    for marker_id, own in opencv_corners(pixels).items():
        _, turn, place = cv2.solvePnP(
            marker_corners_m(size_m), own, camera.matrix, lens, flags=cv2.SOLVEPNP_IPPE_SQUARE
        )
        x_m, y_m, _ = np.ravel(place)
        top = cv2.Rodrigues(turn)[0][:, 1]
        found[int(marker_id)] = np.array([x_m, -y_m, np.arctan2(-top[1], top[0])])
    return found


def fitted(measured: Array, true: Array) -> Array:
    """Return measured (x, y, angle), moved and turned as a whole to fit the true ones best.

    Args:
        measured: In a frame of their own, shape (n, 3).
        true: Shape (n, 3).
    """
    own, world = measured[:, :2].mean(axis=0), true[:, :2].mean(axis=0)
    a, b = measured[:, :2] - own, true[:, :2] - world
    turn = np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum())
    c, s = np.cos(turn), np.sin(turn)
    places = a @ np.array([[c, s], [-s, c]]) + world
    angles = true[:, 2] + wrap_angle_rad(measured[:, 2] + turn - true[:, 2])
    return np.column_stack([places, angles])

"""AprilTags' corners as OpenCV alone has them, refined in their neighbourhood."""

from functools import lru_cache

import cv2
import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels

_HALF_TURN = 2  # corners: OpenCV's AprilTags stand upside down against the AprilTag project's


def opencv_corners(pixels: AnyPixels) -> dict[int, Array]:
    """Return the corners of every AprilTag by its id, clockwise from the top left, (4, 2)."""
    corners, ids, _ = _detector().detectMarkers(pixels)
    return {
        int(marker_id): np.roll(np.asarray(one, dtype=np.float64).reshape(4, 2), _HALF_TURN, axis=0)
        for one, marker_id in zip(corners, np.ravel(ids), strict=False)  # ids: None where none is
    }


@lru_cache
def _detector() -> "cv2.aruco.ArucoDetector":
    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    return cv2.aruco.ArucoDetector(dictionary, parameters)

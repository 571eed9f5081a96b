"""OpenCV's ArUco detector with each of its refinements.

NONE, SUBPIX and CONTOUR answer in our convention. APRILTAG is a port of the AprilTag library's
search, and its corners lie 0.45 px too far to the right and down: measured on exact pictures, the
same for every size. It is taken off, so that the comparison is of accuracy, not of convention.
"""

from typing import Literal

import cv2
import numpy as np

from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.convention import from_opencv_pictures
from tagmetry.lab.engines.engine import Found

Refinement = Literal["NONE", "SUBPIX", "CONTOUR", "APRILTAG"]

_APRILTAG_SHIFT_PX = 0.45


class OpenCv:
    """`cv2.aruco.ArucoDetector` with its defaults but for the refinement."""

    def __init__(self, family_name: str, threads: int, refinement: Refinement) -> None:
        cv2.setNumThreads(threads)
        parameters = cv2.aruco.DetectorParameters()
        parameters.cornerRefinementMethod = getattr(cv2.aruco, f"CORNER_REFINE_{refinement}")
        self._detector = cv2.aruco.ArucoDetector(_dictionary(family_name), parameters)
        self._family = family_name
        self._shift_px = _APRILTAG_SHIFT_PX if refinement == "APRILTAG" else 0.0

    def detect(self, grey: GreyPixels) -> Found:
        """Return the markers in an image."""
        corners, ids, _ = self._detector.detectMarkers(grey)
        found = Found.of(ids if len(corners) else [], np.asarray(corners))
        corners_px = from_opencv_pictures(found.corners_px, self._family)
        return Found(found.ids, corners_px - self._shift_px)


def none(family_name: str, threads: int) -> OpenCv:
    """Make it without refinement."""
    return OpenCv(family_name, threads, "NONE")


def subpix(family_name: str, threads: int) -> OpenCv:
    """Make it with the refinement by gradients."""
    return OpenCv(family_name, threads, "SUBPIX")


def contour(family_name: str, threads: int) -> OpenCv:
    """Make it with the refinement by lines through contours."""
    return OpenCv(family_name, threads, "CONTOUR")


def apriltag(family_name: str, threads: int) -> OpenCv:
    """Make it with the AprilTag library's search."""
    return OpenCv(family_name, threads, "APRILTAG")


def _dictionary(family_name: str) -> cv2.aruco.Dictionary:
    wanted = f"DICT_{family_name.replace('tag', 'apriltag_')}".upper()
    constants = {name.upper(): name for name in dir(cv2.aruco) if name.startswith("DICT_")}
    return cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, constants[wanted]))

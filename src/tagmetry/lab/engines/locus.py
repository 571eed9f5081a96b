"""locus-tag, a detector in Rust.

Its corners begin where OpenCV's do, and its integers are the pixels' corners.
"""

from locus import Detector, TagFamily

from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.convention import HALF_PIXEL, from_opencv_pictures
from tagmetry.lab.engines.engine import Found

_NAMES = {
    "tag16h5": "AprilTag16h5",
    "tag36h11": "AprilTag36h11",
    "4x4_50": "ArUco4x4_50",
    "4x4_100": "ArUco4x4_100",
    "6x6_250": "ArUco6x6_250",
    "aruco_mip_36h12": "ArUcoMip36h12",
}


class Locus:
    """The library's detector with its profile for accuracy, which is its quickest here too."""

    def __init__(self, family: str, threads: int) -> None:
        self._detector = Detector(
            profile="high_accuracy",
            threads=threads,
            families=[getattr(TagFamily, _NAMES[family])],
        )
        self._family = family

    def detect(self, grey: GreyPixels) -> Found:
        """Return the markers in an image."""
        batch = self._detector.detect(grey)
        found = Found.of(batch.ids, batch.corners)
        corners_px = from_opencv_pictures(found.corners_px, self._family)
        return Found(found.ids, corners_px - HALF_PIXEL)

"""The AprilTag library, through pyapriltags; some of its builds crash at exit or on tiny images.

Its corners go counter-clockwise from the bottom left, and its integers are the pixels' corners.
"""

import numpy as np
from pyapriltags import Detector

from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.convention import HALF_PIXEL
from tagmetry.lab.engines.engine import Found


class AprilTag:
    """The library's detector with its defaults but for the decimation."""

    def __init__(self, family: str, threads: int, decimation: float) -> None:
        self._detector = Detector(family, nthreads=threads, quad_decimate=decimation)

    def detect(self, grey: GreyPixels) -> Found:
        """Return the markers in an image."""
        tags = self._detector.detect(grey)
        corners = np.array([tag.corners[::-1] for tag in tags])
        return Found.of([tag.tag_id for tag in tags], corners - HALF_PIXEL)


def whole(family: str, threads: int) -> AprilTag:
    """Make it so that it searches all pixels."""
    return AprilTag(family, threads, 1.0)


def decimated(family: str, threads: int) -> AprilTag:
    """Make it so that it searches every second row and column, as is its default."""
    return AprilTag(family, threads, 2.0)

"""Our own tracker: it follows markers from image to image."""

from tagmetry.detect import Tracker
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.engine import Found
from tagmetry.lab.engines.own import found_of

_RATE_HZ = 30.0


class Tracking:
    """`tagmetry.detect.Tracker` on images that come 30 times a second."""

    def __init__(self, family: str, threads: int) -> None:
        import cv2

        cv2.setNumThreads(threads)
        self._tracker = Tracker([family])
        self._count = 0

    def detect(self, grey: GreyPixels) -> Found:
        """Return the markers in the next image."""
        self._count += 1
        return found_of(self._tracker.track(grey, self._count / _RATE_HZ))

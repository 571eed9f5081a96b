"""Our own detector on the whole image."""

from tagmetry.detect import Detection, Detector
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.engine import Found


class WholeImage:
    """`tagmetry.Detector` with its defaults."""

    def __init__(self, family: str, threads: int) -> None:
        import cv2

        cv2.setNumThreads(threads)
        self._detector = Detector([family])

    def detect(self, grey: GreyPixels) -> Found:
        """Return the markers in an image."""
        return found_of(self._detector.detect(grey))


def found_of(detections: tuple[Detection, ...]) -> Found:
    """Return our detections as any engine's."""
    return Found.of(
        [one.id for one in detections],
        [one.corners_px for one in detections],
        [one.corners_cov_px2 for one in detections],
    )

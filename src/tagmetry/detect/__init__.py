"""From an image to identified markers with sub-pixel corners."""

from tagmetry.detect.detection import Detection, Findings, Rejection
from tagmetry.detect.detector import Detector
from tagmetry.detect.track import Lost, Tracker

__all__ = ["Detection", "Detector", "Findings", "Lost", "Rejection", "Tracker"]

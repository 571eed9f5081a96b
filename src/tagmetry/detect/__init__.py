"""From an image to identified markers with sub-pixel corners."""

from tagmetry.detect.detection import Detection, Findings, Rejection
from tagmetry.detect.detector import Detector

__all__ = ["Detection", "Detector", "Findings", "Rejection"]

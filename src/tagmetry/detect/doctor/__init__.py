"""Why is nothing, or something wrong, found in this image? Answers in words."""

from tagmetry.detect.doctor.advice import Advice, Severity
from tagmetry.detect.doctor.calibration import check_calibration
from tagmetry.detect.doctor.diagnose import diagnose, found_markers, problems_first
from tagmetry.detect.doctor.distances import MeasuredMarker, check_distances

__all__ = [
    "Advice",
    "MeasuredMarker",
    "Severity",
    "check_calibration",
    "check_distances",
    "diagnose",
    "found_markers",
    "problems_first",
]

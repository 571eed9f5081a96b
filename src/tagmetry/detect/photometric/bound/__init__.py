"""How well can corners be known at all, and how well does the detector know them?"""

from tagmetry.detect.photometric.bound.corners import corner_bound_px, corner_bound_px2
from tagmetry.detect.photometric.bound.detector import detector_covariance_px2
from tagmetry.detect.photometric.bound.seen import Print

__all__ = ["Print", "corner_bound_px", "corner_bound_px2", "detector_covariance_px2"]

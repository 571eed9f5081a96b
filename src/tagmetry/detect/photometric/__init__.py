"""Markers' whole pictures fitted to the raw pixels."""

from tagmetry.detect.photometric.model import LOOK_COUNT
from tagmetry.detect.photometric.refine import Fitted, Picture, fit_pictures

__all__ = ["LOOK_COUNT", "Fitted", "Picture", "fit_pictures"]

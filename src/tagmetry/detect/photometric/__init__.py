"""Markers' whole pictures fitted to the raw pixels."""

from tagmetry.detect.photometric.refine import Fitted, Picture, fit_pictures

__all__ = ["Fitted", "Picture", "fit_pictures"]

"""Zoom, focus and calibration driven by the measured depth: what to set next, and when to stop."""

from tagmetry.lens.choice import Whereabouts, best_setting, next_setting
from tagmetry.lens.exposure import Levels, better_exposure_s, bracket, marker_levels
from tagmetry.lens.focus_fit import FocusFit, fit_focus_laws
from tagmetry.lens.focus_law import DioptreLaw, FocusLaw, LogLaw, SplineLaw
from tagmetry.lens.focus_peak import FocusPeak, aperture_m, focus_peak
from tagmetry.lens.lag import Effect, Lag
from tagmetry.lens.measured import Measured, measured
from tagmetry.lens.motion import Motion
from tagmetry.lens.readable import DepthRange, MarkerKind, depth_of_reading
from tagmetry.lens.scan import quick_scan, search_around, seed_scan
from tagmetry.lens.seed import SeedRule, real_depth_m
from tagmetry.lens.setting import LensSetting
from tagmetry.lens.sharpness import marker_blur_px
from tagmetry.lens.together import together
from tagmetry.lens.zoom_lens import ZoomLens

__all__ = [
    "DepthRange",
    "DioptreLaw",
    "Effect",
    "FocusFit",
    "FocusLaw",
    "FocusPeak",
    "Lag",
    "LensSetting",
    "Levels",
    "LogLaw",
    "MarkerKind",
    "Measured",
    "Motion",
    "SeedRule",
    "SplineLaw",
    "Whereabouts",
    "ZoomLens",
    "aperture_m",
    "best_setting",
    "better_exposure_s",
    "bracket",
    "depth_of_reading",
    "fit_focus_laws",
    "focus_peak",
    "marker_blur_px",
    "marker_levels",
    "measured",
    "next_setting",
    "quick_scan",
    "real_depth_m",
    "search_around",
    "seed_scan",
    "together",
]

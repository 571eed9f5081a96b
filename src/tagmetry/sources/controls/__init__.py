"""Controls of real cameras, and which images show what was set."""

from tagmetry.sources.controls.by_hand import by_hand
from tagmetry.sources.controls.controlled import controlled
from tagmetry.sources.controls.evidence import shows_scale, step_grey2
from tagmetry.sources.controls.open import open_controls
from tagmetry.sources.controls.opencv import OpenCvControls
from tagmetry.sources.controls.settling import Settling
from tagmetry.sources.controls.v4l2_controls import V4l2Controls

__all__ = [
    "OpenCvControls",
    "Settling",
    "V4l2Controls",
    "by_hand",
    "controlled",
    "open_controls",
    "shows_scale",
    "step_grey2",
]

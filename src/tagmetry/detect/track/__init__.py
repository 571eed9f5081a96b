"""Markers followed from image to image, each found anew in every one."""

from tagmetry.detect.track.lost import Lost
from tagmetry.detect.track.tracker import Tracker

__all__ = ["Lost", "Tracker"]

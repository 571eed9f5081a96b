"""Zoom, focus and calibration driven on a running camera."""

from tagmetry.pipeline.lens.converge import converge
from tagmetry.pipeline.lens.drive import Drive, Taken
from tagmetry.pipeline.lens.follow import follow
from tagmetry.pipeline.lens.search import search
from tagmetry.pipeline.lens.session import measure_marker, measure_markers
from tagmetry.pipeline.lens.step import LensStep
from tagmetry.pipeline.lens.task import Finder, LensTask

__all__ = [
    "Drive",
    "Finder",
    "LensStep",
    "LensTask",
    "Taken",
    "converge",
    "follow",
    "measure_marker",
    "measure_markers",
    "search",
]

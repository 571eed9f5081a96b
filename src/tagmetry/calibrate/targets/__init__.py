"""Boards in pictures: which points of a board a picture shows, where, and how certain."""

from tagmetry.calibrate.targets.edges import Edges, predicted_edges
from tagmetry.calibrate.targets.find import BoardFindings, explain_board, find_board
from tagmetry.calibrate.targets.found import DroppedPoint
from tagmetry.calibrate.targets.patches import Patches
from tagmetry.calibrate.targets.quality import QualityLimits, ViewQuality, view_quality
from tagmetry.calibrate.targets.refit import refitted
from tagmetry.calibrate.view import RejectedView

__all__ = [
    "BoardFindings",
    "DroppedPoint",
    "Edges",
    "Patches",
    "QualityLimits",
    "RejectedView",
    "ViewQuality",
    "explain_board",
    "find_board",
    "predicted_edges",
    "refitted",
    "view_quality",
]

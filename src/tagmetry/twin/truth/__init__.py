"""What is exactly so in a picture of the twin: poses, corners, and how much of a marker shows."""

from tagmetry.twin.truth.image import BoardTruth, ImageTruth, MarkerTruth, ThingTruth, image_truth
from tagmetry.twin.truth.line import truth_line

__all__ = [
    "BoardTruth",
    "ImageTruth",
    "MarkerTruth",
    "ThingTruth",
    "image_truth",
    "truth_line",
]

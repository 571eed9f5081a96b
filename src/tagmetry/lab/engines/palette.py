"""The colours that engines have in all pictures; one author's are alike."""

from tagmetry.lab.engines.kinds import OURS, TRACKER

COLOURS = {
    OURS: "#d55e00",
    TRACKER: "#e69f00",
    "opencv-none": "#9bd0f0",
    "opencv-subpix": "#56b4e9",
    "opencv-contour": "#2a87bf",
    "opencv-apriltag": "#0b4f79",
    "apriltag": "#009e73",
    "apriltag-2": "#66c2a5",
    "locus": "#cc79a7",
}

"""Poses over time, and how far two such trajectories are apart."""

from tagmetry.localize.trajectory.alignment import Alignment, AlignmentName, alignment
from tagmetry.localize.trajectory.comparison import Comparison, Spread, compare
from tagmetry.localize.trajectory.matching import Matched, matched
from tagmetry.localize.trajectory.trajectory import Trajectory

__all__ = [
    "Alignment",
    "AlignmentName",
    "Comparison",
    "Matched",
    "Spread",
    "Trajectory",
    "alignment",
    "compare",
    "matched",
]

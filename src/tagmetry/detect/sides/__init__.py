"""Corners from the sides of markers alone, for those whose picture does not fit.

sides (where they are expected) -> window (the pixels around) -> step (where the edge is) ->
straighten (what to believe of bows) -> refine (all of these).
"""

from tagmetry.detect.sides.refine import Corners, refine

__all__ = ["Corners", "refine"]

"""Corners fitted again, their edges known from a camera instead of from each other.

Edges bend behind a lens, and a corner is pulled to the inside of a curve that is taken for another
(`saddles`). What rows and columns of corners tell of the curve ends at the board's border; a camera
and the board's pose tell it everywhere.
"""

from dataclasses import replace

import numpy as np

from tagmetry.calibrate.targets.edges import Edges
from tagmetry.calibrate.targets.patches import Patches
from tagmetry.calibrate.targets.saddles import fit_saddles
from tagmetry.calibrate.view import BoardView

_FARTHEST_PX = 1.0  # farther away it is something else


def refitted(view: BoardView, patches: Patches, edges: Edges) -> BoardView:
    """Return a view with its corners fitted as crossings of known edges.

    A corner whose fit is none, moves farther than a pixel, or is less certain than a pixel stays
    where it was.

    Args:
        view: The corners.
        patches: The pixels around each.
        edges: How the camera shows the edges at each.
    """
    along_px, down_px = np.moveaxis(edges.steps_px, -1, 0)
    guesses_px = view.corners_px - patches.origins_px
    window = (patches.half, patches.arm)
    fit = fit_saddles(patches.pixels, guesses_px, along_px, down_px, *window, edges.bends)
    moved_px = fit.centres_px - guesses_px
    good = fit.is_saddle & (np.linalg.norm(moved_px, axis=1) < _FARTHEST_PX)
    good &= fit.sd_px < _FARTHEST_PX
    return replace(
        view,
        corners_px=view.corners_px + np.where(good[:, None], moved_px, 0.0),
        covariances_px2=np.where(good[:, None, None], fit.covariances_px2, view.covariances_px2),
    )

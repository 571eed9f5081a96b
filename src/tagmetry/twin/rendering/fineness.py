"""How much finer than pixels a picture is computed, and how far light spreads."""

import numpy as np

from tagmetry.twin.optics.spread import Spread, fine_scale
from tagmetry.twin.rendering.shot import Optics, Shot

_PROFILE_ERROR = 3e-3  # of the contrast, at worst, on one pixel at an edge along the grid
_EDGE_ERROR_PX = 2.5e-4  # of an edge's place on a sheet seen from the side
_FINEST = 8
LARGEST_DISC_PX = 120
_REACH = 4.5  # standard deviations of the Gaussian


def fine_of(shot: Shot, moved_px: float = 0.0) -> int:
    """Return how many points of the grid make a pixel's side.

    Args:
        shot: How much is blurred; facing sheets without blur need one.
        moved_px: How far edges would be moved on a grid of whole pixels (`lean`).
    """
    for_blur = fine_scale(Spread(shot.optics.blur_px), _PROFILE_ERROR)
    for_lean = int(np.ceil(np.sqrt(moved_px / _EDGE_ERROR_PX)))
    needed = min(max(for_blur, for_lean), _FINEST)
    if shot.optics.lens is not None:
        needed = max(needed, 2)
    return shot.sampling * needed


def gaussian_reach_px(optics: Optics) -> int:
    """Return how far the Gaussian part of the point spread reaches."""
    return int(np.ceil(_REACH * optics.blur_px)) + (optics.blur_px > 0)

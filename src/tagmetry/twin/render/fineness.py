"""How much finer than pixels a picture is computed, and how far light spreads."""

import numpy as np

from tagmetry.twin.render.shot import Optics, Shot
from tagmetry.twin.spread import Spread, fine_scale

_PROFILE_ERROR = 3e-3  # of the contrast, at worst, on one pixel at an edge along the grid
_FINEST = 8
LARGEST_DISC_PX = 120
_REACH = 4.5  # standard deviations of the Gaussian


def fine_of(shot: Shot) -> int:
    """Return how many points of the grid make a pixel's side; without blur, one is exact."""
    needed = min(fine_scale(Spread(shot.optics.blur_px), _PROFILE_ERROR), _FINEST)
    if shot.optics.lens is not None:
        needed = max(needed, 2)
    return shot.sampling * needed


def gaussian_reach_px(optics: Optics) -> int:
    """Return how far the Gaussian part of the point spread reaches."""
    return int(np.ceil(_REACH * optics.blur_px)) + (optics.blur_px > 0)

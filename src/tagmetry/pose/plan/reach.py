"""How far a marker is found: where its shortest side has as many pixels as the detector needs.

A cell must be wider than what blur and motion smear it over, and stand out of the noise over its
area. The numbers are fitted to where the detector finds 95 % of the twin's markers, over noise,
blur, motion, contrast, tilt and family (`tagmetry lab run detector`).
"""

from dataclasses import replace

import numpy as np
from scipy.optimize import brentq

from tagmetry.detect.detector import default_min_side_px
from tagmetry.pose.plan.setup import Setup

_LEAST_CELL_PX, _CELL_PER_SPREAD = 0.45, 1.6
_CELL_PX_TIMES_SIGNAL_TO_NOISE = 15.0
_PIXEL_VARIANCE_PX2 = 1 / 12  # of a square pixel
_STEP, _STEPS = 1.3, 40  # distances that are tried, from the marker's size to 28000 times that


def shortest_side_px(setup: Setup) -> float:
    """Return how long a marker's shortest side must be for 95 % of them to be found."""
    look = setup.imaging
    motion2_px2 = float(np.dot(setup.motion_px, setup.motion_px)) / 12
    spread_px = np.sqrt(look.blur_px**2 + _PIXEL_VARIANCE_PX2 + motion2_px2)
    sharp_px = _LEAST_CELL_PX + _CELL_PER_SPREAD * spread_px
    clear_px = _CELL_PX_TIMES_SIGNAL_TO_NOISE / look.signal_to_noise
    cells_px = setup.marker_family.layout.side_cells * max(sharp_px, clear_px)
    return float(max(cells_px, default_min_side_px(int(np.prod(setup.camera.size_px)))))


def range_m(setup: Setup) -> float:
    """Return the farthest distance at which the marker is found; 0 where at none.

    The setup's own distance does not matter.
    """

    def spare_px(distance_m: float) -> float:
        there = replace(setup, distance_m=distance_m)
        return there.short_side_px - shortest_side_px(there)

    distances_m = (setup.size_m * _STEP ** np.arange(_STEPS)).tolist()
    found = [n for n, distance_m in enumerate(distances_m) if spare_px(distance_m) > 0]
    if not found:
        return 0.0
    last = found[-1]
    return float(brentq(spare_px, distances_m[last], distances_m[last + 1], rtol=1e-4))

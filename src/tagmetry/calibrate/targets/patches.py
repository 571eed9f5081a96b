"""What is kept of a picture to fit a board's corners again: the pixels around each."""

import math
from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.targets.window import reach_px
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels, IntArray

_SLACK, _SLACK_PX = 1.1, 2  # windows along better known steps may be larger


@dataclass(frozen=True, eq=False)
class Patches:
    """The pixels around the corners of a view, and the windows in which they were fitted.

    Attributes:
        pixels: One patch for each corner, 8-bit, shape (n, height, width).
        origins_px: Column and row of each one's first pixel, shape (n, 2).
        half: Half a window's side, in steps.
        arm: How far from an edge pixels may lie, in steps (`fit_saddles`).
    """

    pixels: GreyPixels
    origins_px: IntArray
    half: float
    arm: float


def cut_out(
    grey: GreyPixels, corners_px: Array, steps_px: Array, half: float, arm: float
) -> Patches | None:
    """Return the pixels around corners; None where there are no corners.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: Shape (n, 2).
        steps_px: From each to the next ones, one in each column, shape (n, 2, 2).
        half: Half a window's side, in steps.
        arm: How far from an edge pixels may lie, in steps.
    """
    if not len(corners_px):
        return None
    farthest_px = max(max(reach_px(step, half)) for step in steps_px)
    reach = math.ceil(_SLACK * farthest_px) + _SLACK_PX
    height, width = (min(2 * reach + 1, side) for side in grey.shape)
    last_px = np.array([grey.shape[1] - width, grey.shape[0] - height])
    origins_px = np.clip(np.rint(corners_px).astype(np.int64) - reach, 0, last_px)
    everywhere = np.lib.stride_tricks.sliding_window_view(grey, (height, width))
    patches = everywhere[origins_px[:, 1], origins_px[:, 0]]
    return Patches(np.ascontiguousarray(patches), origins_px, half, arm)

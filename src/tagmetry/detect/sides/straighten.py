"""What to believe of a side's fit: its bow, and the errors that the fit cannot know.

How strongly the sides bow is judged on all of the image together: their spread beyond what noise
explains is what each side's own bow is then believed with, so straight sides cost no accuracy and
bowed ones no honesty.
"""

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_FLOOR_PX = 0.005  # what the model does not describe, per side
_LEAK = (0.9, 1.3)  # how far blur carries the next cells into a side; measured on rendered markers


def straightened(
    line: Array, covariance: Array, half_px: Array, tells: BoolArray
) -> tuple[Array, Array]:
    """Believe the sides' bows as far as all of them together show that sides bow here.

    The spread of curvatures beyond their own errors is estimated over the image (DerSimonian and
    Laird's moment), then each side is updated with the prior that its bow is zero within it.

    Args:
        line: (offset, turn, bow) of each side, shape (s, 3).
        covariance: Shape (s, 3, 3).
        half_px: Half lengths, shape (s,).
        tells: Sides whose bow was fitted and counts, shape (s,).

    Returns:
        (offset, turn), shape (s, 2), and their covariances, shape (s, 2, 2).
    """
    bow, bow2 = line[:, 2], np.maximum(covariance[:, 2, 2], 1e-12)
    weight = np.where(tells, half_px**4 / bow2, 0.0)
    excess = (weight * bow**2 / half_px**4).sum() - tells.sum()
    spread2 = max(0.0, excess / max(weight.sum(), 1e-300)) * half_px**4
    gain = covariance[:, :2, 2] / (bow2 + spread2)[:, None]
    shift = line[:, :2] - gain * bow[:, None]
    return shift, covariance[:, :2, :2] - gain[:, :, None] * covariance[:, 2, None, :2]


def model_error(cell_px: Array, blur_px: Array) -> Array:
    """Return the covariance of (offset, turn) by what a lone step does not describe, (s, 2, 2).

    Where cells are few blurs wide, the bits behind the border and what lies behind the quiet zone
    reach into the window; by how much depends on the code.
    """
    amplitude, decay = _LEAK
    leak_px = amplitude * blur_px * np.exp(-cell_px / (decay * blur_px))
    variance = _FLOOR_PX**2 + leak_px**2
    return np.asarray(variance[:, None, None] * np.diag([1.0, 1 / 3]))

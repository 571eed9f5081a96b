"""How blurred is a marker? The width of the steps of light along its four sides."""

import numpy as np

from tagmetry.detect import Detection
from tagmetry.detect.doctor.edges import side_blurs_px
from tagmetry.detect.grey import grey_8bit
from tagmetry.geometry.arrays import AnyPixels


def marker_blur_px(pixels: AnyPixels, detection: Detection, side_cells: int) -> float:
    """Return the standard deviation of the blur of a marker's sides; NaN where none is clear.

    Args:
        pixels: The image.
        detection: The marker in it.
        side_cells: Cells along its side.
    """
    if side_cells < 1:
        return float("nan")
    cell_px = detection.side_px / side_cells
    blurs = side_blurs_px(grey_8bit(pixels), detection.corners_px, cell_px)
    clear = blurs[np.isfinite(blurs)]
    return float(np.median(clear)) if len(clear) else float("nan")

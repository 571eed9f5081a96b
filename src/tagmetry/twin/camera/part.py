"""The part of what is read that a window of the image needs, or all of it."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import csr_array

from tagmetry.camera import cropped
from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.camera.readout import Readout
from tagmetry.twin.rendering.box import Box


@dataclass(frozen=True, eq=False)
class Part:
    """What is read for a window of the image.

    Attributes:
        read: The part of the sensor.
        rows_later: How many rows its middle is below that of everything that is read.
        shown: From the signal of the part to the window's.
    """

    read: Readout
    rows_later: float
    shown: Callable[[FloatImage], FloatImage]


def whole(read: Readout) -> Part:
    """Return everything that is read, for the whole image."""
    return Part(read, 0.0, read.shown)


def part_for(read: Readout, window: Box, reach_px: int) -> Part:
    """Return the part for a window.

    Args:
        read: Everything that is read for the image.
        window: Pixels of the image.
        reach_px: How far around a pixel that is read its neighbours matter.
    """
    across, left, right = _needed(read.weights(0)[window.left : window.right], reach_px)
    down, top, bottom = _needed(read.weights(1)[window.top : window.bottom], reach_px)
    own = replace(read, camera=cropped(read.camera, left, top, right - left, bottom - top))

    def shown(signal: FloatImage) -> FloatImage:
        return np.asarray((across @ (down @ signal).T).T, np.float32)

    return Part(own, (top + bottom - read.camera.height_px) / 2, shown)


def _needed(weights: csr_array, reach_px: int) -> tuple[csr_array, int, int]:
    """Return the weights of the pixels that are needed, the first of these and the one after."""
    used = weights.indices[weights.data != 0]
    first = max(int(used.min()) - reach_px, 0)
    after = min(int(used.max()) + 1 + reach_px, weights.shape[1])
    return csr_array(weights[:, first:after]), first, after

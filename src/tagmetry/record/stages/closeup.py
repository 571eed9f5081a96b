"""A part of an image, much enlarged, with the places of the image still known."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.record.display import displayable


@dataclass(frozen=True, eq=False)
class Closeup:
    """An enlarged part to draw on.

    Attributes:
        canvas: BGR, shape (h, w, 3).
        first_px: The image's place of the part's first pixel, x and y.
        times: Enlargement.
    """

    canvas: GreyPixels
    first_px: Array
    times: int

    @classmethod
    def around(cls, grey: GreyPixels, low_px: Array, high_px: Array, width_px: int) -> "Closeup":
        """Return the part of an image between two places, about so wide."""
        limit = np.array([grey.shape[1], grey.shape[0]]) - 1
        first = np.clip(np.floor(low_px), 0, limit).astype(int)
        last = np.clip(np.ceil(high_px), first, limit).astype(int)
        part = grey[first[1] : last[1] + 1, first[0] : last[0] + 1]
        times = max(1, width_px // part.shape[1])
        return cls(displayable(enlarged(part, times)), first.astype(np.float64), times)

    def at(self, points_px: Array) -> Array:
        """Return where places of the image (..., 2) are on the canvas."""
        return np.asarray((points_px - self.first_px + 0.5) * self.times - 0.5)


def enlarged(pixels: GreyPixels, times: int) -> GreyPixels:
    """Return each pixel as a square of pixels."""
    return np.repeat(np.repeat(pixels, times, axis=0), times, axis=1)

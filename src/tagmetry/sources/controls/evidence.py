"""What says that an image shows a change: how much it differs from the one before."""

import cv2
import numpy as np

from tagmetry.geometry.arrays import AnyPixels, GreyPixels

_BLOCK_PX = 24  # a marker that is worth looking at fills one; noise has 576 pixels to average out


def step_grey2(before: AnyPixels, after: AnyPixels) -> float:
    """Return the greatest mean squared difference over the blocks of two images, 8-bit greys.

    A small marker that gets sharp is as clear in it as a whole image that gets brighter. For images
    of different sizes it is infinite.

    Args:
        before: Grey or BGR, 8 or 16 bits.
        after: The next one.
    """
    one, other = _grey(before), _grey(after)
    if one.shape != other.shape:
        return float("inf")
    difference = cv2.absdiff(one, other)
    squared = cv2.multiply(difference, difference, dtype=cv2.CV_16U)
    blocks = (max(one.shape[1] // _BLOCK_PX, 1), max(one.shape[0] // _BLOCK_PX, 1))
    return float(np.max(cv2.resize(squared, blocks, interpolation=cv2.INTER_AREA)))


def shows_scale(before_px: float, now_px: float, factor: float) -> bool:
    """Say whether a marker's size follows a change of zoom rather than being as it was.

    Args:
        before_px: Side of the marker before the change.
        now_px: Side of the marker in the image that is asked about.
        factor: New zoom by old zoom, positive.
    """
    grown, wanted = np.log(now_px / before_px), np.log(factor)
    return bool(abs(grown - wanted) <= abs(grown))


def _grey(pixels: AnyPixels) -> GreyPixels:
    """Return 8-bit greys; the scale of 16 bits is kept, as stretching would change it."""
    if pixels.dtype == np.uint16:
        pixels = (pixels >> 8).astype(np.uint8)
    if pixels.ndim == 3 and pixels.shape[2] >= 3:
        pixels = cv2.cvtColor(np.ascontiguousarray(pixels[..., :3]), cv2.COLOR_BGR2GRAY)
    return np.asarray(pixels.reshape(pixels.shape[:2]), np.uint8)

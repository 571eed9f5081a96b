"""The grey values of those parts of an image that are looked at; nothing else is converted."""

import cv2
import numpy as np

from tagmetry.detect.grey import check_pixels, grey_8bit
from tagmetry.geometry.arrays import AnyPixels, Array, GreyPixels, IntArray

_CODES = {3: cv2.COLOR_BGR2GRAY, 4: cv2.COLOR_BGRA2GRAY}


class Greyed:
    """An image in grey, part by part.

    Attributes:
        grey: Shape (height, width); black where nobody asked to look yet.
        is_whole: All of it is there.
    """

    def __init__(self, pixels: AnyPixels) -> None:
        """Take an image of any kind that a detector takes; 16 bits are converted whole."""
        check_pixels(pixels)
        self._pixels = pixels
        self.is_whole = not (pixels.dtype == np.uint8 and pixels.ndim == 3 and pixels.shape[2] > 1)
        self.grey = grey_8bit(pixels) if self.is_whole else np.zeros(pixels.shape[:2], np.uint8)

    @property
    def size_px(self) -> tuple[int, int]:
        """(width, height)."""
        return self.grey.shape[1], self.grey.shape[0]

    def look_at(self, boxes: IntArray) -> GreyPixels:
        """Return the image with boxes (n, 4) converted: left, top, and past the right and bottom.

        Args:
            boxes: Within the image.
        """
        if self.is_whole:
            return self.grey
        width, height = boxes[:, 2] - boxes[:, 0], boxes[:, 3] - boxes[:, 1]
        if (width * height).sum() > self.grey.size:
            boxes, self.is_whole = np.array([[0, 0, *self.size_px]]), True
        code = _CODES[self._pixels.shape[2]]
        for left, top, right, bottom in boxes:
            if left < right and top < bottom:
                part = self._pixels[top:bottom, left:right]
                self.grey[top:bottom, left:right] = cv2.cvtColor(part, code)
        return self.grey


def boxes_around(corners_px: Array, pad_px: Array, size_px: tuple[int, int]) -> IntArray:
    """Return the boxes around squares, as far as they lie in the image, shape (n, 4).

    Args:
        corners_px: Shape (n, 4, 2).
        pad_px: How much more is taken on each side, shape (n,).
        size_px: (width, height) of the image.
    """
    with np.errstate(invalid="ignore"):
        low = np.floor(corners_px.min(axis=1) - pad_px[:, None])
        high = np.ceil(corners_px.max(axis=1) + pad_px[:, None]) + 1
    box = np.nan_to_num(np.concatenate([low, high], axis=1), posinf=0.0, neginf=0.0)
    return np.asarray(np.clip(box, 0, [*size_px, *size_px]), dtype=np.int64)

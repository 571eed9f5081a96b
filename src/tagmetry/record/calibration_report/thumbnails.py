"""The pictures of the views, small, with what was found in them."""

import cv2
import numpy as np

from tagmetry.calibrate.view import BoardView
from tagmetry.geometry.arrays import AnyPixels, BoolArray, GreyPixels
from tagmetry.record.palette import ORANGE, VERMILLION

_SCALE = 8  # sub-pixel steps of OpenCV's drawing: 2^3


def outlined(small: GreyPixels, view: BoardView, kept: BoolArray) -> AnyPixels:
    """Return a small picture with its view's corners; those that were left out in red.

    Args:
        small: The view's picture, small and grey.
        view: What was found in the large one.
        kept: Which corners were used, shape (n,).
    """
    drawn = cv2.cvtColor(small, cv2.COLOR_GRAY2BGR)
    share = np.array(small.shape[::-1]) / view.size_px
    places = (view.corners_px + 0.5) * share - 0.5
    for (x, y), used in zip(np.rint(places * _SCALE).astype(int).tolist(), kept, strict=True):
        color = ORANGE if used else VERMILLION
        radius = (1 if used else 3) * _SCALE
        cv2.circle(drawn, (x, y), radius, color, -1, cv2.LINE_AA, shift=3)
    return np.asarray(drawn)


def jpeg(pixels: AnyPixels) -> bytes:
    """Return a picture as JPEG."""
    _, content = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, 80])
    return bytes(content)

"""One picture of a step, with a caption below it."""

import textwrap
from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.record.display import displayable
from tagmetry.record.drawing import draw_text
from tagmetry.record.palette import DARK, WHITE, YELLOW

_LEAST_WIDTH_PX = 640
_TEXT_SHARE = 1 / 40  # height of the caption's letters by the picture's width
_LETTER = 0.56  # width of a letter by its height
_LINE = 1.5


@dataclass(frozen=True, eq=False)
class Panel:
    """A picture of one step.

    Attributes:
        name: Short, for the file's name.
        title: What is shown.
        text: What happens here, with this image's numbers.
        pixels: BGR, shape (h, w, 3), uint8.
    """

    name: str
    title: str
    text: str
    pixels: GreyPixels


def shown(pixels: AnyPixels) -> GreyPixels:
    """Return a picture to draw on, enlarged by a whole factor where it is small."""
    canvas = displayable(pixels)
    times = max(1, -(-_LEAST_WIDTH_PX // (2 * canvas.shape[1])))
    return np.ascontiguousarray(np.repeat(np.repeat(canvas, times, axis=0), times, axis=1))


def captioned(panel: Panel, number: int) -> GreyPixels:
    """Return the picture with its number, title and text below it."""
    pixels = _widened(panel.pixels)
    width = pixels.shape[1]
    size_px = max(13.0, _TEXT_SHARE * min(width, 1.5 * _LEAST_WIDTH_PX))
    letters = int(0.96 * width / (_LETTER * size_px))
    lines = [f"{number}. {panel.title}", *textwrap.wrap(panel.text, letters)]
    band = np.full((int((len(lines) + 0.8) * _LINE * size_px), width, 3), DARK, dtype=np.uint8)
    for k, line in enumerate(lines):
        middle = np.array([width / 2, (0.5 + k) * _LINE * size_px])
        draw_text(band, line, middle, size_px, YELLOW if k == 0 else WHITE)
    return np.concatenate([pixels, band])


def png(pixels: GreyPixels) -> bytes:
    """Return a picture as PNG."""
    _, content = cv2.imencode(".png", pixels, [cv2.IMWRITE_PNG_COMPRESSION, 3])
    return bytes(content.tobytes())


def jpeg(pixels: GreyPixels) -> bytes:
    """Return a picture as JPEG, a fifth of the size."""
    _, content = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, 90])
    return bytes(content.tobytes())


def _widened(pixels: GreyPixels) -> GreyPixels:
    """Return a narrow picture in the middle of a ground that has room for the text."""
    missing = max(0, _LEAST_WIDTH_PX - pixels.shape[1])
    sides = (missing // 2, missing - missing // 2)
    return np.stack(
        [np.pad(pixels[..., k], [(0, 0), sides], constant_values=DARK[k]) for k in range(3)],
        axis=2,
    )

"""Lines, dots and text at sub-pixel places, with a dark rim that shows on any background.

An integer coordinate is a pixel's centre. Everything is drawn into the given canvas, shape
(height, width, 3), uint8; what lies outside of it, or is not finite, is left out.
"""

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry.arrays import Array, GreyPixels
from tagmetry.record.palette import DARK, Color

if TYPE_CHECKING:
    import cv2

SHIFT = 4  # fractional bits of OpenCV's coordinates: 1/16 px
MARGIN_PX = 64.0  # lines are cut this far outside the canvas, where no rim reaches back into it


@dataclass(frozen=True)
class Pen:
    """How a line looks.

    Attributes:
        color: Blue, green, red.
        width_px: Its width without the rim.
        rim_px: Width of the dark rim on either side.
    """

    color: Color
    width_px: int = 1
    rim_px: int = 1


def draw_path(canvas: GreyPixels, points_px: Array, pen: Pen, *, closed: bool = False) -> None:
    """Draw lines from point to point, (n, 2); without those that touch a NaN."""
    following = np.roll(points_px, -1, axis=0) if closed else points_px[1:]
    segments = np.stack([points_px[: len(following)], following], axis=1)
    segments = clip_segments(segments, canvas.shape[1], canvas.shape[0])
    if pen.rim_px > 0:
        _draw_segments(canvas, segments, DARK, pen.width_px + 2 * pen.rim_px)
    _draw_segments(canvas, segments, pen.color, pen.width_px)


def draw_dot(canvas: GreyPixels, point_px: Array, radius_px: float, color: Color) -> None:
    """Draw a filled disc with a dark rim of a quarter of its radius, at least one pixel."""
    import cv2

    height, width = canvas.shape[:2]
    if not _is_near(point_px, width, height):
        return
    x, y = _fixed(point_px)
    for radius, paint in ((radius_px + max(1.0, radius_px / 4), DARK), (radius_px, color)):
        cv2.circle(canvas, (x, y), round(radius * 2**SHIFT), paint, -1, cv2.LINE_AA, SHIFT)


def draw_text(
    canvas: GreyPixels, text: str, anchor_px: Array, height_px: float, color: Color
) -> None:
    """Write a line of text, centred below a point, moved so that it stays on the canvas."""
    import cv2

    height, width = canvas.shape[:2]
    if not _is_near(anchor_px, width, height):
        return
    face, size = _font(), max(1, round(height_px))
    rim = max(1, size // 12)
    box = cv2.getTextSize((width, height), text, (0, 0), face, size, 600)
    left = _clamped(anchor_px[0] - box[2] / 2, rim, width - box[2] - rim)
    top = _clamped(anchor_px[1], rim, height - box[3] - rim)
    for dx, dy in [(x, y) for x in (-rim, 0, rim) for y in (-rim, 0, rim) if (x, y) != (0, 0)]:
        cv2.putText(canvas, text, (left + dx, top - box[1] + dy), DARK, face, size, 600)
    cv2.putText(canvas, text, (left, top - box[1]), color, face, size, 600)


def clip_segments(segments_px: Array, width_px: int, height_px: int) -> Array:
    """Return the parts of segments, (n, 2, 2), that can touch the canvas, (m, 2, 2) with m <= n.

    Reference:
        Liang and Barsky, "A new concept and method for line clipping", 1984.
    """
    start = segments_px[:, 0]
    with np.errstate(all="ignore"):
        step = segments_px[:, 1] - start
        to_low = (-MARGIN_PX - start) / step
        to_high = (np.array([width_px, height_px]) + MARGIN_PX - start) / step
        enter = np.fmin(to_low, to_high).max(axis=1).clip(min=0.0)[:, None]
        leave = np.fmax(to_low, to_high).min(axis=1).clip(max=1.0)[:, None]
        cut = np.stack([start + enter * step, start + leave * step], axis=1)
    kept = np.isfinite(cut).all(axis=(1, 2)) & (enter <= leave)[:, 0]
    return np.asarray(cut[kept])


@cache
def _font() -> "cv2.FontFace":
    import cv2

    return cv2.FontFace("sans")


def _draw_segments(canvas: GreyPixels, segments_px: Array, color: Color, width_px: int) -> None:
    import cv2

    fixed = np.rint(segments_px * 2**SHIFT).astype(np.int32)
    cv2.polylines(canvas, list(fixed), False, color, width_px, cv2.LINE_AA, SHIFT)


def _is_near(point_px: Array, width_px: int, height_px: int) -> bool:
    """Say whether a point is finite and on the canvas or close to it."""
    limit = np.array([width_px, height_px]) + MARGIN_PX
    return bool(((point_px > -MARGIN_PX) & (point_px < limit)).all())


def _fixed(point_px: Array) -> tuple[int, int]:
    x, y = np.rint(point_px * 2**SHIFT).astype(int).tolist()
    return x, y


def _clamped(value: float, low: int, high: int) -> int:
    return max(low, min(round(value), high))

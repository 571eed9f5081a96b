"""Widths and heights that suit a marker's size and the picture's."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.geometry.arrays import Array, GreyPixels


@dataclass(frozen=True)
class Scale:
    """How large the marks of one marker are drawn.

    Attributes:
        line_px: Width of its outline.
        text_px: Height of its text.
    """

    line_px: int
    text_px: float

    @classmethod
    def of(cls, corners_px: Array, canvas: GreyPixels) -> Self:
        """Return the scale for a marker with these corners on this canvas."""
        diagonal = float(np.hypot(*canvas.shape[:2]))
        sides = np.roll(corners_px, -1, axis=0) - corners_px
        side = float(np.linalg.norm(sides, axis=1).mean())
        line = max(1, round(min(side / 50, diagonal / 350)))
        return cls(line, min(max(side / 5, caption_px(canvas)), max(10.0, diagonal / 30)))


def caption_px(canvas: GreyPixels) -> float:
    """Return the smallest height of text that can be read when the picture fills a screen."""
    return max(10.0, float(np.hypot(*canvas.shape[:2])) / 110)

"""Exposure by the marker's own contrast: its paper, not the room, is to be well lit.

The marker's white is brought to about 70 % of the range. What light a value stands for is taken by
a response of gamma 2.2; where it is another, a second step corrects the first. In backlight, where
no marker is found at all, `bracket` gives exposures around the present one.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.camera.controls import Control
from tagmetry.detect import Detection
from tagmetry.detect.grey import grey_8bit
from tagmetry.geometry import Array, apply_homography, square_to_quad
from tagmetry.geometry.arrays import AnyPixels

_GAMMA = 2.2
_WANTED = 0.7
_WITHIN = 0.12
_SATURATED = 250
_MOST_CHANGE = 4.0
_BRACKET = (1.0, 1 / 4, 4.0, 1 / 16, 16.0)
_ALONG = np.linspace(0.1, 0.9, 9)


@dataclass(frozen=True)
class Levels:
    """Grey values of a marker, 0 to 255.

    Attributes:
        black: Of its border.
        white: Of the paper around it.
    """

    black: float
    white: float

    @property
    def contrast(self) -> float:
        """White minus black."""
        return self.white - self.black


def marker_levels(pixels: AnyPixels, detection: Detection, side_cells: int) -> Levels:
    """Return the medians of a marker's dark border and of the paper half a cell outside it."""
    grey = grey_8bit(pixels)
    half = 0.5 / max(side_cells, 1)
    rings = [_sampled(grey, detection.corners_px, inset) for inset in (half, -half)]
    dark, light = (float(np.median(ring)) for ring in rings)
    return Levels(min(dark, light), max(dark, light))


def better_exposure_s(levels: Levels, exposure_s: float, control: Control) -> float:
    """Return the exposure that brings the marker's white to where it should be.

    Args:
        levels: The marker's.
        exposure_s: The present exposure.
        control: What the camera takes.

    Returns:
        The present exposure where it is good enough.
    """
    share = levels.white / 255
    if levels.white >= _SATURATED:
        return control.nearest(exposure_s / 2.5)
    if abs(share - _WANTED) <= _WITHIN:
        return exposure_s
    change = (_WANTED / max(share, 0.02)) ** _GAMMA
    return control.nearest(exposure_s * float(np.clip(change, 1 / _MOST_CHANGE, _MOST_CHANGE)))


def bracket(exposure_s: float, control: Control) -> tuple[float, ...]:
    """Return exposures to try where nothing is found: this one, a quarter, four times, and on."""
    return tuple(dict.fromkeys(control.nearest(exposure_s * factor) for factor in _BRACKET))


def _sampled(grey: AnyPixels, corners_px: Array, inset: float) -> Array:
    """Return grey values along a square inside the marker's sides (outside where negative)."""
    low, high = inset, 1 - inset
    at = low + (high - low) * _ALONG
    fixed_low, fixed_high = np.full_like(at, low), np.full_like(at, high)
    square = np.concatenate(
        [
            np.stack(pair, axis=1)
            for pair in ((at, fixed_low), (at, fixed_high), (fixed_low, at), (fixed_high, at))
        ]
    )
    places = apply_homography(square_to_quad(corners_px), square).astype(np.float32)
    values = cv2.remap(
        grey, places[:, :1], places[:, 1:], cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
    return np.asarray(values, dtype=np.float64).ravel()

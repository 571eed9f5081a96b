"""The auto modes of a simulated camera: simple loops that look at the images it gives out.

Auto exposure brings the mean grey value to 45 % of the range: first by exposure, then by gain.
Auto focus climbs: it steps on while the image gets sharper, turns with half the step when not, and
rests at one step of the control until the sharpness has changed by 30 %. Sharpness is the mean
squared slope of the whole image, so a lively background wins over a small marker, as it does in
real cameras.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.camera.controls import Control
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.twin.camera.setting import Setting

_WANTED_GREY = 0.45
_NEAR_ENOUGH = 0.02
_MOST_CHANGE = 4.0
_COARSER = 2  # sharpness is looked at in an image so many times smaller
_FIRST_SHARE = 1 / 8  # of the control's range, the first step of auto focus
_CHANGED = 0.3


def better_exposed(
    setting: Setting, pixels: AnyPixels, white_grey: int, exposure: Control | None
) -> tuple[float, float] | None:
    """Return exposure (seconds) and gain for an image of medium brightness.

    Args:
        setting: What the image was taken with; delays do no harm then.
        pixels: The image.
        white_grey: Its greatest grey value.
        exposure: Range of the exposure; None where it cannot be set.

    Returns:
        None where the image is good enough.
    """
    grey = max(float(np.mean(pixels)) / white_grey, 1 / 255)
    change = float(np.clip(_WANTED_GREY / grey, 1 / _MOST_CHANGE, _MOST_CHANGE))
    if abs(change - 1) < _NEAR_ENOUGH:
        return None
    wanted_s = setting.exposure_s * setting.gain * change
    taken_s = exposure.nearest(wanted_s) if exposure else setting.exposure_s
    return taken_s, max(wanted_s / taken_s, 1.0)


@dataclass(frozen=True)
class Climb:
    """How far auto focus is.

    Attributes:
        step: What it adds to the focus value next; its sign is the direction.
        best: Sharpest so far: focus value and sharpness.
        rests: Whether it has found the top.
    """

    step: float
    best: tuple[float, float] = (np.nan, -np.inf)
    rests: bool = False

    def next(self, focus: float, sharpness: float, control: Control) -> tuple["Climb", float]:
        """Return what comes after an image, and the focus value to go to.

        Args:
            focus: Where the motor was for the image.
            sharpness: Of the image.
            control: Range and step of the focus.
        """
        if self.rests:
            return self._watching(focus, sharpness, control), focus
        if sharpness > self.best[1]:
            return self._onward((focus, sharpness), self.step, control)
        step = -self.step / 2
        if abs(step) < max(control.step, 1e-3 * (control.most - control.least)):
            return Climb(step, self.best, rests=True), self.best[0]
        return self._onward(self.best, step, control)

    def _onward(
        self, best: tuple[float, float], step: float, control: Control
    ) -> tuple["Climb", float]:
        """Step on from the best place, away from an end of the range."""
        if not control.least <= best[0] + step <= control.most:
            step = -step
        return Climb(step, best), control.nearest(best[0] + step)

    def _watching(self, focus: float, sharpness: float, control: Control) -> "Climb":
        """Begin again once the image has changed, or somebody else moved the focus."""
        is_same = abs(sharpness - self.best[1]) <= _CHANGED * self.best[1]
        return self if is_same and focus == self.best[0] else first_climb(control)


def first_climb(control: Control) -> Climb:
    """Return auto focus at its beginning."""
    return Climb(_FIRST_SHARE * (control.most - control.least))


def sharpness_of(pixels: AnyPixels) -> float:
    """Return the mean squared slope of an image that was made smaller."""
    height, width = (max(size // _COARSER, 1) for size in pixels.shape)
    small = cv2.resize(pixels, (width, height), interpolation=cv2.INTER_AREA).astype(np.float64)
    return float(np.mean(np.diff(small, axis=0) ** 2) + np.mean(np.diff(small, axis=1) ** 2))

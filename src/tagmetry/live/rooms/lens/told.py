"""From steps of a driven lens to what the page is told."""

from collections import deque

import cv2
import numpy as np

from tagmetry.live.rooms.lens.messages import LensPhase, LensPicture, LensPoint, LensTrace
from tagmetry.pipeline.lens import LensStep

_MOST_POINTS = 200
_WIDTH_PX = 960
_JPEG_QUALITY = 70
_NAN = float("nan")


class Trace:
    """Collects what the newest images gave."""

    def __init__(self) -> None:
        self._points: deque[LensPoint] = deque(maxlen=_MOST_POINTS)
        self._images = 0
        self._converged_s = _NAN
        self._phase: LensPhase = "preparing"

    def take(self, step: LensStep, true_m: float) -> None:
        """Add an image."""
        found, setting, time_s = step.found, step.setting, step.image.time_s
        depth, sd = (found.depth_m, found.depth_sd_m) if found is not None else (_NAN, _NAN)
        point = LensPoint(time_s, setting.zoom_percent, setting.focus, depth, sd, true_m)
        self._points.append(point)
        self._images += 1
        self._phase = step.phase
        if step.is_final and np.isnan(self._converged_s):
            self._converged_s = time_s

    def told(self, why: str = "", phase: LensPhase | None = None) -> LensTrace:
        """Return it as it is sent."""
        points = tuple(self._points)
        return LensTrace(phase or self._phase, points, self._images, self._converged_s, why)


def told_picture(step: LensStep) -> LensPicture:
    """Return an image as it is sent, with the marker that was found in it."""
    scale = min(1.0, _WIDTH_PX / step.image.width_px)
    pixels = step.image.pixels
    small = cv2.resize(pixels, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    _, jpeg = cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
    corners = step.found.detection.corners_px if step.found is not None else np.zeros((0, 2))
    scaled = tuple((x, y) for x, y in (scale * (corners + 0.5) - 0.5).tolist())
    return LensPicture(small.shape[1], small.shape[0], scaled, jpeg.tobytes())

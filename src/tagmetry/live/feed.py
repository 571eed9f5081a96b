"""From moments and pictures to messages, no more often than a page can use them."""

import time
from collections.abc import Callable

import cv2
import numpy as np

from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.eye import Look
from tagmetry.live.messages import Health, Picture, Told, World
from tagmetry.live.rates import Rate
from tagmetry.live.recording import Recordings
from tagmetry.live.stage import Performance
from tagmetry.live.told import told_markers, told_world
from tagmetry.live.told_stage import told_stage
from tagmetry.pipeline.arena_twin import Moment

_WORLD_S, _HEALTH_S = 1 / 20, 0.5
_WORLD_SENDS_PER_S, _PICTURE_SENDS_PER_S = 3000, 500  # to all pages together
_MOST_WIDTH_PX, _JPEG_QUALITY = 960, 75


class Feed:
    """Gives messages to whoever tells the pages.

    Attributes:
        notice: What went wrong last; empty while all is well.
        viewers: How many pages there are; many are told less often.
    """

    def __init__(self, give: Callable[[Told], None], recordings: Recordings) -> None:
        """Begin.

        Args:
            give: Takes every message, in the thread that made it, and returns at once.
            recordings: What health tells about.
        """
        self.notice, self.viewers = "", 0
        self._give, self._recordings = give, recordings
        self._images, self._pictures = Rate(), Rate()
        self._world_s = self._health_s = float("-inf")
        self._picture_s: float | None = None  # when the newest was made

    def moment(self, moment: Moment, show: Performance, why: str | None, took_s: float) -> None:
        """Tell where the robots are, unless that was told just now.

        Args:
            moment: The newest.
            show: What runs.
            why: Why the stop for all is pressed; None while it is not.
            took_s: Time that it took.
        """
        self._images.count(took_s)
        step_s = max(_WORLD_S, self.viewers / _WORLD_SENDS_PER_S)
        if time.monotonic() - self._world_s >= step_s:
            self._world_s = time.monotonic()
            self._tell(told_world(moment, show.arena.scenario, show.steered, why))

    def stage(self, show: Performance) -> None:
        """Tell what robots are among."""
        self._give(told_stage(show))

    def picture(self, look: Look, pixels: AnyPixels, show: Performance) -> None:
        """Tell what the camera sees, unless many pages were told just now."""
        now_s, step_s = time.monotonic(), self.viewers / _PICTURE_SENDS_PER_S
        if self._picture_s is not None and now_s - self._picture_s < step_s:
            return
        self._picture_s = now_s
        self._pictures.count()
        small = _halved(pixels) if pixels.shape[1] > _MOST_WIDTH_PX else pixels
        height_px, width_px = small.shape[:2]
        scale = width_px / show.arena.scenario.view.camera.width_px
        markers = told_markers(look.detections, show.roster, scale)
        self._tell(Picture(look.time_s, look.taken_s, width_px, height_px, markers, _jpeg(small)))

    def _tell(self, message: World | Picture) -> None:
        self._recordings.told(message)
        self._give(message)

    def health(self, show: Performance, late_s: float) -> None:
        """Tell how the measurement does, unless that was told just now."""
        now_s = time.monotonic()
        if now_s - self._health_s < _HEALTH_S:
            return
        self._health_s = now_s
        self._give(
            Health(
                show.name,
                self._images.per_s,
                late_s,
                self._images.mean_s,
                self._pictures.per_s,
                None if self._picture_s is None else now_s - self._picture_s,
                self.viewers,
                self._recordings.name,
                self.notice or self._recordings.failure,
            )
        )


def _halved(pixels: AnyPixels) -> AnyPixels:
    return np.asarray(cv2.resize(pixels, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA))


def _jpeg(pixels: AnyPixels) -> bytes:
    _, packed = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
    return packed.tobytes()

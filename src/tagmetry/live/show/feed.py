"""From moments and pictures to messages, no more often than a page can use them."""

import time
from collections.abc import Callable

import cv2
import numpy as np

from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.health.vitals import Vitals
from tagmetry.live.messages import Picture, Told, World
from tagmetry.live.show.eye import Look
from tagmetry.live.show.recording import Recordings
from tagmetry.live.show.stage import Performance
from tagmetry.live.show.told import told_markers, told_world
from tagmetry.live.show.told_stage import told_stage
from tagmetry.pipeline.arena import StageTimes
from tagmetry.pipeline.arena_twin import Moment

_WORLD_S, _HEALTH_S = 1 / 20, 0.5
_WORLD_SENDS_PER_S, _PICTURE_SENDS_PER_S = 1000, 150  # to all pages together
_HEALTH_SENDS_PER_S = 250
_MOST_WIDTH_PX, _JPEG_QUALITY = 960, 75


class Feed:
    """Gives messages to whoever tells the pages.

    Attributes:
        vitals: How the measurement does.
    """

    def __init__(self, give: Callable[[Told], None], recordings: Recordings) -> None:
        """Begin.

        Args:
            give: Takes every message, in the thread that made it, and returns at once.
            recordings: Take what is told, while one is written.
        """
        self.vitals = Vitals(recordings)
        self._give, self._recordings = give, recordings
        self._world_s = self._picture_s = self._health_s = float("-inf")

    def moment(self, moment: Moment, show: Performance, why: str | None, took_s: float) -> None:
        """Tell where the robots are, unless that was told just now.

        Args:
            moment: The newest.
            show: What runs.
            why: Why the stop for all is pressed; None while it is not.
            took_s: Time that it took.
        """
        self.vitals.image(took_s)
        self._count(moment.turn.times)
        began_s = time.monotonic()
        if began_s - self._world_s >= max(_WORLD_S, self.vitals.viewers / _WORLD_SENDS_PER_S):
            self._world_s = began_s
            world = told_world(moment, show.arena.scenario, show.steered, why)
            self.vitals.world(world)
            self._tell(world)
            self.vitals.stage("to tell pages", time.monotonic() - began_s)

    def _count(self, times: StageTimes) -> None:
        self.vitals.stage("to follow the robots", times.follow_s)
        self.vitals.stage("to tell robots what they may know", times.tell_s)
        self.vitals.stage("to decide and to ask controllers", times.drive_s)

    def stage(self, show: Performance) -> None:
        """Tell what robots are among."""
        self._give(told_stage(show))

    def picture(self, look: Look, pixels: AnyPixels, show: Performance) -> None:
        """Tell what the camera sees, unless many pages were told just now."""
        began_s = time.monotonic()
        if began_s - self._picture_s < self.vitals.viewers / _PICTURE_SENDS_PER_S:
            return
        self._picture_s = began_s
        small = small_enough(pixels)
        height_px, width_px = small.shape[:2]
        scale = width_px / show.arena.scenario.view.camera.width_px
        markers = told_markers(look.detections, show.roster, scale)
        self._tell(Picture(look.time_s, look.taken_s, width_px, height_px, markers, jpeg_of(small)))
        self.vitals.picture(look)
        self.vitals.stage("to look", look.took_s)
        self.vitals.stage("from an image to its picture", time.monotonic() - look.taken_s)

    def health(self, show: Performance, late_s: float) -> None:
        """Tell how the measurement does, unless that was told just now."""
        now_s = time.monotonic()
        if now_s - self._health_s >= max(_HEALTH_S, self.vitals.viewers / _HEALTH_SENDS_PER_S):
            self._health_s = now_s
            self._give(self.vitals.health(show, late_s))

    def _tell(self, message: World | Picture) -> None:
        self._recordings.told(message)
        self._give(message)


def small_enough(pixels: AnyPixels) -> AnyPixels:
    """Return a picture as pages get it: one that is too wide has half its pixels a side."""
    if pixels.shape[1] <= _MOST_WIDTH_PX:
        return pixels
    return np.asarray(cv2.resize(pixels, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA))


def jpeg_of(pixels: AnyPixels) -> bytes:
    """Return a picture's file."""
    _, packed = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])
    return packed.tobytes()

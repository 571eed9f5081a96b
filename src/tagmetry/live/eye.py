"""The camera of the live arena: markers measured at once, pictures made beside as time allows.

A rendered picture takes longer than an image may, so the arena measures the markers' corners with
noise, and a thread of its own paints what the camera saw at the newest of these moments.
"""

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena import Robot
from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.pipeline.arena_twin import Eye
from tagmetry.pipeline.arena_twin.ready.stage import floor, shot
from tagmetry.twin.robots.overhead import OverheadPictures

PICTURE_S = 0.1  # between two pictures, at least
_REST = 2.0  # times the processor time of a picture, for the thread that runs the robots


@dataclass(frozen=True, eq=False)
class Look:
    """One look down.

    Attributes:
        time_s: The middle of the exposure.
        Ts_world_robot: Where the robots were.
        detections: What was measured.
    """

    time_s: float
    Ts_world_robot: RigidTransform
    detections: tuple[Detection, ...]


class WatchedEye:
    """An eye that remembers its newest look.

    Attributes:
        newest: The last look; None before the first.
    """

    def __init__(self, eye: Eye) -> None:
        self.newest: Look | None = None
        self._eye = eye

    def look(self, time_s: float, Ts_world_robot: RigidTransform) -> tuple[Detection, ...]:
        """Return the markers that an image of this moment shows."""
        detections = self._eye.look(time_s, Ts_world_robot)
        self.newest = Look(time_s, Ts_world_robot, detections)
        return detections


class Painter:
    """Makes pictures of the newest look in a thread of its own."""

    def __init__(
        self,
        robots: Sequence[Robot],
        eye: WatchedEye,
        give: Callable[[Look, AnyPixels], None],
    ) -> None:
        """Begin.

        Args:
            robots: In the order of the scenario.
            eye: Whose newest look is painted.
            give: Takes every picture, in the painter's thread.
        """
        self._robots, self._eye, self._give = robots, eye, give
        self._is_closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="painter", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End after the picture that is being made; does not wait for it."""
        self._is_closing.set()

    def _run(self) -> None:
        pictures = OverheadPictures(floor(), self._robots, shot())
        rng = np.random.default_rng(0)
        painted_s = float("-inf")
        while not self._is_closing.is_set():
            began_s, look = time.thread_time(), self._eye.newest
            if look is not None and look.time_s > painted_s:
                painted_s = look.time_s
                self._give(look, pictures.take(look.Ts_world_robot, rng))
            cost_s = time.thread_time() - began_s
            self._is_closing.wait(max(PICTURE_S - cost_s, _REST * cost_s, 0.005))

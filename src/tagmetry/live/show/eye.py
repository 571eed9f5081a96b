"""The camera of the live arena: an eye that remembers its newest look, for people to see."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.pipeline.arena_twin import Eye


@dataclass(frozen=True, eq=False)
class Look:
    """One look down.

    Attributes:
        time_s: The middle of the exposure, in the arena's clock.
        taken_s: The same in the clock of this computer, `time.monotonic`.
        took_s: How long it took to measure.
        Ts_world_robot: Where the robots were.
        detections: What was measured.
        pixels: The picture that was measured; None where only corners were.
    """

    time_s: float
    taken_s: float
    took_s: float
    Ts_world_robot: RigidTransform
    detections: tuple[Detection, ...]
    pixels: AnyPixels | None = None


class WatchedEye:
    """An eye that remembers its newest look."""

    def __init__(self, eye: Eye, pixels: Callable[[], AnyPixels | None] = lambda: None) -> None:
        """Watch an eye.

        Args:
            eye: Who looks.
            pixels: Gives the picture of its last look, where there is one.
        """
        self._eye, self._pixels = eye, pixels
        self._newest: Look | None = None
        self._looked = threading.Condition()

    @property
    def newest(self) -> Look | None:
        """The last look; None before the first."""
        return self._newest

    def look(self, time_s: float, Ts_world_robot: RigidTransform) -> tuple[Detection, ...]:
        """Return the markers that an image of this moment shows."""
        taken_s = time.monotonic()
        detections = self._eye.look(time_s, Ts_world_robot)
        look = Look(
            time_s, taken_s, time.monotonic() - taken_s, Ts_world_robot, detections, self._pixels()
        )
        with self._looked:
            self._newest = look
            self._looked.notify_all()
        return detections

    def later(self, before: Look | None, timeout_s: float) -> Look | None:
        """Wait for a look that is newer than another, and return it; None where none came."""
        with self._looked:
            self._looked.wait_for(lambda: self._newest is not before, timeout_s)
            return self._newest if self._newest is not before else None

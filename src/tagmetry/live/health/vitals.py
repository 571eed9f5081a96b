"""How the measurement does: counted as it runs, told when asked."""

import shutil
import time
from collections import defaultdict
from pathlib import Path

from tagmetry.live.health.advice import Signs, advice
from tagmetry.live.health.memory import resident_bytes
from tagmetry.live.health.rates import Rate
from tagmetry.live.messages import Health, StageTime, World
from tagmetry.live.show.eye import Look
from tagmetry.live.show.recording import Recordings
from tagmetry.live.show.stage import Performance


class Vitals:
    """Counts images, pictures and how long each step takes.

    Attributes:
        notice: What went wrong last; empty while all is well.
        viewers: How many pages there are.
    """

    def __init__(self, recordings: Recordings) -> None:
        """Begin.

        Args:
            recordings: What is told of them.
        """
        self.notice, self.viewers = "", 0
        self._recordings = recordings
        self._images, self._pictures = Rate(), Rate()
        self._stages: defaultdict[str, Rate] = defaultdict(Rate)
        self._picture_taken_s: float | None = None
        self._world: World | None = None

    def image(self, took_s: float) -> None:
        """Count an image that was measured."""
        self._images.count(took_s)

    def stage(self, name: str, took_s: float) -> None:
        """Count one step of the way of an image, by what people call it."""
        self._stages[name].count(took_s)

    def world(self, world: World) -> None:
        """Take where robots are, and how their links and batteries do."""
        self._world = world

    def picture(self, look: Look) -> None:
        """Count a picture that is on its way."""
        self._pictures.count()
        self._picture_taken_s = look.taken_s

    def health(self, show: Performance, late_s: float) -> Health:
        """Return how the measurement does.

        Args:
            show: What runs.
            late_s: How far it is behind the wall's clock.
        """
        signs = self._signs(show, late_s)
        return Health(
            show.name,
            signs.image_rate_hz,
            late_s,
            self._images.mean_s,
            self._pictures.per_s,
            signs.picture_age_s,
            self.viewers,
            self._recordings.name,
            self.notice or signs.failure,
            tuple(StageTime(name, rate.mean_s) for name, rate in tuple(self._stages.items())),
            max(signs.losses.values(), default=0.0),
            min(signs.batteries_v.values(), default=None),
            resident_bytes(),
            signs.disk_free_bytes,
            signs.dropped_count,
            advice(signs),
        )

    def _signs(self, show: Performance, late_s: float) -> Signs:
        robots = self._world.robots if self._world is not None else ()
        taken_s, recordings = self._picture_taken_s, self._recordings
        batteries_v = {one.name: one.battery_v for one in robots}
        return Signs(
            late_s,
            self._images.per_s,
            show.arena.scenario.image_rate_hz,
            None if taken_s is None else time.monotonic() - taken_s,
            {one.name: one.loss for one in robots},
            {name: known_v for name, known_v in batteries_v.items() if known_v is not None},
            self._world.missing if self._world is not None else (),
            recordings.name is not None,
            recordings.dropped_count,
            _free_bytes(recordings.folder),
            recordings.failure,
        )


def _free_bytes(folder: Path) -> int | None:
    """Return what is free where a folder is, or would be; None where that is not known."""
    there = next(one for one in (folder, *folder.absolute().parents) if one.exists())
    try:
        return shutil.disk_usage(there).free
    except OSError:
        return None

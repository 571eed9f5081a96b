"""The arena that pages look at: runs in a thread of its own, as fast as the wall's clock.

orders of pages -> stop, release, goals, scenarios -> one tick of the twin -> what pages are told

A computer that is too slow lets the arena fall behind the clock; no tick of it is left out.
"""

import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Self

from tagmetry.camera import Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.messages import (
    DRIVING,
    Asked,
    Beat,
    ChooseScenario,
    FollowPath,
    GoTo,
    Halt,
    Release,
    Resume,
    SetParameter,
    StartRecording,
    Stop,
    StopRecording,
    Told,
)
from tagmetry.live.show.commands import command
from tagmetry.live.show.eye import Look
from tagmetry.live.show.feed import Feed
from tagmetry.live.show.orders import Order, Orders
from tagmetry.live.show.programme import Programme
from tagmetry.live.show.recording import Recordings
from tagmetry.live.show.repertoire import Repertoire
from tagmetry.live.show.stage import Performance, performance
from tagmetry.live.show.watch import Watch
from tagmetry.pipeline.arena_twin.run import TICK_S
from tagmetry.pipeline.steady import steady

_MOST_LATE_S = 0.25  # what is missed beyond is not caught up with
_GONE = "the page that drives was closed, hidden or cut off"


class LiveRunner(Closing):
    """Runs a scenario for pages; to be used in a with-block."""

    def __init__(self, programme: Programme, give: Callable[[Told], None]) -> None:
        """Make everything ready.

        Args:
            programme: What is shown.
            give: Takes every message for the pages, and returns at once.

        Raises:
            InputError: There is no such scenario, not for so many robots, or a file is broken.
        """
        self._programme = programme
        self._repertoire = Repertoire(programme.controllers)
        self._recordings = Recordings(programme.recordings)
        self._feed = Feed(give, self._recordings)
        self._orders = Orders()
        self._watch = Watch()
        self._why: str | None = None
        self._late_s = 0.0
        self._show = self._begin(programme.scenario, programme.robots)
        self._is_closing = threading.Event()
        self._thread = threading.Thread(target=self._run, name="arena", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def close(self) -> None:
        """End, and finish the recording."""
        self._is_closing.set()
        self._thread.join()
        self._show.close()
        self._recordings.close()

    @property
    def viewers(self) -> int:
        """How many pages are connected, as the server says."""
        return self._feed.vitals.viewers

    @viewers.setter
    def viewers(self, count: int) -> None:
        self._feed.vitals.viewers = count

    @property
    def scenarios(self) -> tuple[str, ...]:
        """Names of what can be chosen."""
        return self._repertoire.names

    @property
    def recordings(self) -> Path:
        """Folder of what was recorded; may not be there yet."""
        return self._recordings.folder

    @property
    def recording(self) -> str | None:
        """Name of the file that is being written; None while none is."""
        return self._recordings.name

    @property
    def time_s(self) -> float:
        """Now, in the arena's clock."""
        return self._show.arena.time_s

    def ask(self, page: int, asked: Asked) -> None:
        """Take what an operator's page asks for.

        Args:
            page: Its number.
            asked: Its message.

        Raises:
            InputError: Too much waits already.
        """
        self._watch.hear(page)
        if not isinstance(asked, Beat):
            self._orders.put(Order(page, asked))

    def leave(self, page: int) -> None:
        """Take that a page is gone; all robots stop if it was the one that drives."""
        if self._watch.is_driving(page):
            self._orders.put(Order(page, Stop(_GONE)))

    def _run(self) -> None:
        with steady():
            self._keep_pace()

    def _keep_pace(self) -> None:
        due_s = time.monotonic()
        while not self._is_closing.is_set():
            self._obey()
            self._tick()
            due_s = max(due_s + TICK_S, time.monotonic() - _MOST_LATE_S)
            self._late_s = max(time.monotonic() - due_s, 0.0)
            self._feed.health(self._show, self._late_s)
            self._is_closing.wait(max(due_s - time.monotonic(), 0.0))

    def _tick(self) -> None:
        began_s = time.monotonic()
        for moment in self._show.arena.run(TICK_S):
            self._recordings.state(moment.turn.step.world)
            self._feed.moment(moment, self._show, self._why, time.monotonic() - began_s)

    def _obey(self) -> None:
        """Do what was asked, and stop the robots of a page that is gone."""
        for order in self._orders.take():
            try:
                self._do(order)
            except (InputError, OSError) as error:
                self._feed.vitals.notice = str(error)
        if self._watch.is_gone():
            self._stop(_GONE)

    def _do(self, order: Order) -> None:
        if isinstance(order.asked, DRIVING):
            self._watch.drive(order.page)
        self._feed.vitals.notice = ""
        match order.asked:
            case Stop(why):
                self._stop(why)
            case Release():
                self._why = None
                self._show.arena.release()
            case GoTo() | FollowPath() | Halt() | Resume():
                command(self._show.steered, order.asked)
            case SetParameter():
                command(self._show.steered, order.asked)
                self._feed.stage(self._show)
            case ChooseScenario(name, robots):
                self._change(name, robots)
            case StartRecording() | StopRecording():
                self._record(order.asked)

    def _record(self, asked: StartRecording | StopRecording) -> None:
        if isinstance(asked, StartRecording):
            self._recordings.start()
        else:
            self._recordings.stop()

    def _stop(self, why: str) -> None:
        self._watch.rest()
        self._why = self._why or why
        self._show.arena.stop(why)

    def _change(self, name: str, robots: int) -> None:
        before, self._show = self._show, self._begin(name, robots)
        before.close()
        self._why = None

    def _begin(self, name: str, robots: int) -> Performance:
        scenario = self._repertoire.scenario(name, robots)

        def give(look: Look, pixels: AnyPixels) -> None:
            self._recordings.image(Image(pixels, look.time_s, "capture", source="twin"))
            self._feed.picture(look, pixels, show)

        take = give if self._programme.pictures else None
        show = performance(name, scenario, take, self._programme.eye)
        self._feed.stage(show)
        return show

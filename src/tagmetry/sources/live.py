"""A camera or stream as a source: the newest image wins, and a lost camera is fetched back.

A supervisor starts a reader, watches whether it still answers, and after a failure or a hang starts
another, with growing pauses. Only the newest image is kept; `Image.sequence` counts all that were
captured, so gaps show what nobody took in time. `Image.time_s` is the arrival on a monotonic clock
(`time.monotonic`), which has nothing to do with the time of day.
"""

import threading
import time
from collections.abc import Callable, Iterator

from tagmetry.camera import Camera, Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.arrivals import Arrivals
from tagmetry.sources.connection import Opener
from tagmetry.sources.fit import checked_fit
from tagmetry.sources.newest import Newest
from tagmetry.sources.reader import Reader
from tagmetry.sources.state import LiveKind, LiveState, LiveTiming, OnState

_CLOSE_S = 0.5
_GLANCE_S = 0.1  # between two looks at a reader
_MOST_HANGING = 3  # readers left behind in a driver; more would only eat memory


class LiveSource(Closing):
    """The newest images of a camera or stream."""

    def __init__(
        self,
        name: str,
        opener: Opener,
        *,
        camera: Camera | None = None,
        on_state: OnState | None = None,
        timing: LiveTiming | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Start to read.

        Args:
            name: Address or device, for people.
            opener: Opens the camera or stream; called again after each loss, from other threads.
            camera: Intrinsics; an image of another size raises InputError where it is taken.
            on_state: Told every change of state, from other threads; must return quickly.
            timing: How patient to be.
            clock: Seconds that never go back.
        """
        self.name = name
        self._opener, self._on_state = opener, on_state
        self._timing, self._clock = timing or LiveTiming(), clock
        self._newest: Newest[Image] = Newest()
        self._arrivals = Arrivals(name, camera)
        self._turn = threading.RLock()  # who holds it may change the reader and the state
        self._state = LiveState("connecting")
        self._reader: Reader | None = None
        self._left_behind: list[Reader] = []
        self._is_closed = threading.Event()
        self._supervisor = threading.Thread(target=self._supervise, name=name, daemon=True)
        self._supervisor.start()

    @property
    def is_live(self) -> bool:
        """Yes: images that nobody takes in time are dropped."""
        return True

    @property
    def length(self) -> int | None:
        """Unknown."""
        return None

    @property
    def opener(self) -> Opener:
        """What opens the camera or stream."""
        return self._opener

    @property
    def state(self) -> LiveState:
        """How the source is doing now."""
        return self._state

    def __iter__(self) -> Iterator[Image]:
        """Give the newest image each time, waiting for one, until the source is closed.

        Raises:
            InputError: The first connection failed, or an image does not fit the intrinsics.
        """
        while (image := self._newest.take()) is not None:
            yield checked_fit(image)

    def close(self) -> None:
        """Stop within a second, even while a read hangs in a driver."""
        self._is_closed.set()
        self._newest.close()
        if threading.current_thread() is not self._supervisor:
            self._supervisor.join(_CLOSE_S)
        self._change("closed")

    def _supervise(self) -> None:
        """Read, and reconnect after each loss; only a source that never worked gives up."""
        pause_s = self._timing.first_pause_s
        try:
            while not self._is_closed.is_set():
                count = self._arrivals.count
                reason = self._read_until_lost()
                self._change("lost", reason)
                if not self._arrivals.count:
                    return self._newest.close(InputError(f"{self.name}: {reason}"))
                if self._arrivals.count > count:
                    pause_s = self._timing.first_pause_s
                self._is_closed.wait(pause_s)
                self._change("reconnecting", reason)
                pause_s = self._timing.next_pause_s(pause_s)
        finally:
            self._newest.close()

    def _read_until_lost(self) -> str:
        """Run one reader and return why it ended."""
        self._left_behind = [reader for reader in self._left_behind if reader.is_alive]
        if len(self._left_behind) >= _MOST_HANGING:
            return f"{_MOST_HANGING} reads hang in the driver"
        reader = self._start()
        reason = self._watch(reader)
        with self._turn:
            self._reader = None
        reader.leave()
        self._left_behind.append(reader)
        return reason

    def _start(self) -> Reader:
        with self._turn:  # it may deliver before this returns
            self._reader = Reader(self.name, self._opener, self._take, self._clock)
            return self._reader

    def _watch(self, reader: Reader) -> str:
        while not self._is_closed.is_set():
            if reader.wait_for_end(min(_GLANCE_S, self._timing.hang_s / 4)):
                return reader.failure
            if reader.silence_s() > self._timing.hang_s:
                return f"no answer for {self._timing.hang_s:g} s"
        return ""

    def _take(self, reader: Reader, pixels: AnyPixels, time_s: float) -> None:
        """Keep what the present reader brings; called from its thread."""
        with self._turn:
            if reader is not self._reader:
                return
            image = self._arrivals.add(pixels, time_s)
            if image is not None:
                self._newest.put(image)
                self._change("running")
            elif self._arrivals.repeated_s(time_s) > self._timing.frozen_s:
                self._change("frozen", "the same image again and again")

    def _change(self, kind: LiveKind, reason: str = "") -> None:
        with self._turn:
            if self._state.kind in (kind, "closed"):
                return
            self._state = LiveState(kind, reason)
            if self._on_state is not None:
                self._on_state(self._state)

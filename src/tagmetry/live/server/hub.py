"""From the arena's threads to the pages: each page has one place a kind, and the newest wins.

A page that takes its time finds the newest message when it comes back; what it missed is gone, and
nobody waited for it.
"""

import asyncio
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass
from itertools import count
from typing import TypeVar

from tagmetry.errors import InputError
from tagmetry.live.health.delays import Delays
from tagmetry.live.messages import Refused, Told
from tagmetry.live.messages.wire import format_message, packed

MOST_PAGES = 1100


Frame = str | bytes
_What = TypeVar("_What", int, str)


class Slot:
    """What one page has not taken yet.

    Attributes:
        page: Its number.
        told: Messages that it took.
        missed: Messages that a newer one replaced before it took them.
    """

    def __init__(self, page: int = 0) -> None:
        self.page = page
        self.told = self.missed = 0
        self._newest: dict[str, Frame] = {}
        self._paced: set[str] = set()
        self._held: set[str] = set()
        self._changed = asyncio.Event()

    def first(self, frame: Frame) -> None:
        """Put a message before all others."""
        self._newest = {"": frame, **self._newest}
        self._changed.set()

    def put(self, kind: str, frame: Frame) -> None:
        """Replace what is there of this kind."""
        self.missed += kind in self._newest
        self._newest[kind] = frame
        self._changed.set()

    def shown(self, kind: str) -> None:
        """Take that the page shows the last of a kind; it then gets these one at a time."""
        self._paced.add(kind)
        self._held.discard(kind)
        self._changed.set()

    async def frames(self) -> AsyncIterator[Frame]:
        """Give what comes, oldest kind first, for ever."""
        while True:
            await self._changed.wait()
            self._changed.clear()
            while (kind := self._next()) is not None:
                self.told += 1
                self._held |= {kind} & self._paced
                yield self._newest.pop(kind)

    def _next(self) -> str | None:
        return next((kind for kind in self._newest if kind not in self._held), None)


@dataclass(frozen=True)
class Counts:
    """Messages since the beginning, to all pages together.

    Attributes:
        told: That were taken.
        missed: That a newer one replaced before.
    """

    told: int
    missed: int


class Hub:
    """Tells all pages.

    Attributes:
        delays: From an image until a page shows its picture, as pages say.
    """

    def __init__(self) -> None:
        self.delays = Delays()
        self._gone = Counts(0, 0)
        self._slots: set[Slot] = set()
        self._numbers = count(1)
        self._last: dict[str, Frame] = {}
        self._loop: asyncio.AbstractEventLoop | None = None

    def open(self) -> None:
        """Begin to tell; called in the server's loop."""
        self._loop = asyncio.get_running_loop()

    def close(self) -> None:
        """Tell nothing more."""
        self._loop = None

    @property
    def pages(self) -> int:
        """How many pages are connected."""
        return len(self._slots)

    @property
    def counts(self) -> Counts:
        """Messages to all pages, also to those that are gone."""
        told = sum(slot.told for slot in self._slots)
        missed = sum(slot.missed for slot in self._slots)
        return Counts(self._gone.told + told, self._gone.missed + missed)

    def join(self) -> Slot:
        """Return a new page's slot, with the newest of every kind.

        Raises:
            InputError: There are too many pages.
        """
        if len(self._slots) >= MOST_PAGES:
            raise InputError(f"{MOST_PAGES} pages are connected already")
        slot = Slot(next(self._numbers))
        for kind, frame in dict(self._last).items():
            slot.put(kind, frame)
        self._slots.add(slot)
        return slot

    def leave(self, slot: Slot) -> None:
        """Forget a page."""
        self._slots.discard(slot)
        self._gone = Counts(self._gone.told + slot.told, self._gone.missed + slot.missed)

    def give(self, message: Told) -> None:
        """Tell all pages; from any thread, and returns at once.

        What is told while the server does not run yet, its first page will find.
        """
        self.pass_on(type(message).__name__, packed(message))

    def pass_on(self, kind: str, frame: Frame) -> None:
        """Tell all pages what was packed elsewhere; from any thread, and returns at once."""
        if self._loop is None:
            self._last[kind] = frame
        else:
            self._call(self._spread, kind, frame)

    def refuse(self, page: int, refused: Refused) -> None:
        """Tell one page, by its number, that what it asked for was not done; from any thread."""
        self._call(self._tell_one, page, format_message(refused))

    def _call(self, do: Callable[[_What, Frame], None], what: _What, frame: Frame) -> None:
        """Do something in the server's loop, if there is one."""
        loop = self._loop
        try:
            if loop is not None:
                loop.call_soon_threadsafe(do, what, frame)
        except RuntimeError:
            self._loop = None  # the server has ended meanwhile

    def _tell_one(self, page: int, frame: Frame) -> None:
        for slot in self._slots:
            if slot.page == page:
                slot.put(Refused.__name__, frame)

    def _spread(self, kind: str, frame: Frame) -> None:
        self._last[kind] = frame
        for slot in self._slots:
            slot.put(kind, frame)

"""From the arena's threads to the pages: each page has one place a kind, and the newest wins.

A page that takes its time finds the newest message when it comes back; what it missed is gone, and
nobody waited for it.
"""

import asyncio
from collections.abc import AsyncIterator

from tagmetry.errors import InputError
from tagmetry.live.messages import Told
from tagmetry.live.wire import format_message

MOST_PAGES = 1100


class Slot:
    """What one page has not taken yet."""

    def __init__(self) -> None:
        self._newest: dict[str, str] = {}
        self._changed = asyncio.Event()

    def first(self, text: str) -> None:
        """Put a message before all others."""
        self._newest = {"": text, **self._newest}
        self._changed.set()

    def put(self, kind: str, text: str) -> None:
        """Replace what is there of this kind."""
        self._newest[kind] = text
        self._changed.set()

    async def texts(self) -> AsyncIterator[str]:
        """Give what comes, oldest kind first, for ever."""
        while True:
            await self._changed.wait()
            self._changed.clear()
            while self._newest:
                yield self._newest.pop(next(iter(self._newest)))


class Hub:
    """Tells all pages."""

    def __init__(self) -> None:
        self._slots: set[Slot] = set()
        self._last: dict[str, str] = {}
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

    def join(self) -> Slot:
        """Return a new page's slot, with the newest of every kind.

        Raises:
            InputError: There are too many pages.
        """
        if len(self._slots) >= MOST_PAGES:
            raise InputError(f"{MOST_PAGES} pages are connected already")
        slot = Slot()
        for kind, text in dict(self._last).items():
            slot.put(kind, text)
        self._slots.add(slot)
        return slot

    def leave(self, slot: Slot) -> None:
        """Forget a page."""
        self._slots.discard(slot)

    def give(self, message: Told) -> None:
        """Tell all pages; from any thread, and returns at once.

        What is told while the server does not run yet, its first page will find.
        """
        loop, text = self._loop, format_message(message)
        if loop is None:
            self._last[type(message).__name__] = text
            return
        try:
            loop.call_soon_threadsafe(self._spread, type(message).__name__, text)
        except RuntimeError:
            self._loop = None  # the server has ended meanwhile

    def _spread(self, kind: str, text: str) -> None:
        self._last[kind] = text
        for slot in self._slots:
            slot.put(kind, text)

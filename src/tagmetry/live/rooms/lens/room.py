"""The lens room: starts and stops for operators; everybody may watch."""

import asyncio
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, cast

from fastapi import Request, Response
from fastapi.responses import JSONResponse

from tagmetry.live.messages import Asked, Told
from tagmetry.live.rooms.lens.bank import bank_table
from tagmetry.live.rooms.lens.drive import Drive
from tagmetry.live.rooms.lens.messages import StartLens, StopLens
from tagmetry.live.rooms.lens.scene import checked
from tagmetry.live.rooms.only import OnlyWork
from tagmetry.live.rooms.room import Room, words

_PATIENCE_S = 2.0  # of a request for the bank


def lens_room(give: Callable[[Told], None]) -> Room:
    """Return the room.

    Args:
        give: Takes every message for the pages, from any thread.
    """
    desk = _Desk(give)
    return Room(
        answers={"/lens/bank": desk.bank},
        takers={StartLens: desk.start, StopLens: desk.stop},
        close=desk.close,
    )


class _Desk:
    """Knows the one drive that runs."""

    def __init__(self, give: Callable[[Told], None]) -> None:
        self._give = give
        self._drive: OnlyWork[Drive] = OnlyWork(
            runs="the lens is being driven already; stop it first",
            rests="the lens is not being driven",
        )
        self._solver = ThreadPoolExecutor(1, "lens bank")
        self._bank: Future[dict[str, Any]] | None = None

    def start(self, asked: Asked) -> None:
        """Look for the marker."""
        wanted = checked(cast("StartLens", asked))
        self._drive.begin(lambda: Drive(wanted, self._give))

    def stop(self, _: Asked) -> None:
        """Stop where it is."""
        self._drive.end()

    async def bank(self, _: Request) -> Response:
        """Return the calibrations; solved when the first page asks, which takes seconds."""
        if self._bank is None:
            self._bank = self._solver.submit(bank_table)
        solved, _waiting = await asyncio.wait(
            [asyncio.wrap_future(self._bank)], timeout=_PATIENCE_S
        )
        if not solved:
            return words("being solved; ask again", 409)
        return JSONResponse(self._bank.result())

    def close(self) -> None:
        """End what runs."""
        self._drive.close()
        self._solver.shutdown(wait=False, cancel_futures=True)

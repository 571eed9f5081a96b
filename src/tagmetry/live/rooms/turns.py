"""Requests that take a while: one at a time, in a thread beside the server's; some may wait."""

import asyncio
from collections.abc import Callable

from fastapi import Request, Response

from tagmetry.errors import InputError
from tagmetry.live.rooms.room import Answer, words


class Turns:
    """Whose turn it is in a room."""

    def __init__(self, most_waiting: int, crowded: str) -> None:
        """Begin with nobody.

        Args:
            most_waiting: Who comes when so many are there is sent away.
            crowded: What they are told.
        """
        self._most_waiting, self._crowded = most_waiting, crowded
        self._turn, self._waiting = asyncio.Semaphore(1), 0

    def answer(self, make: Callable[[Request], Response]) -> Answer:
        """Return an answer that is made when it is its turn; what is refused is told in words."""

        async def made(request: Request) -> Response:
            if self._waiting >= self._most_waiting:
                return words(self._crowded, 503)
            self._waiting += 1
            try:
                async with self._turn:
                    return await asyncio.to_thread(make, request)
            except (InputError, OSError) as error:
                return words(str(error), 422)
            finally:
                self._waiting -= 1

        return made

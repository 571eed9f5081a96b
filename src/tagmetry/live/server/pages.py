"""The socket of a page: what it is told, what it asks, and what happens when it is gone."""

import asyncio
import time
from collections.abc import Sequence

from fastapi import WebSocket

from tagmetry.errors import InputError
from tagmetry.live.messages import Asked, Picture, Refused, Role, Seen, Welcome
from tagmetry.live.messages.wire import format_message, parse_asked
from tagmetry.live.rooms.room import Room
from tagmetry.live.running import Runner
from tagmetry.live.server.access import Access
from tagmetry.live.server.hub import Hub, Slot
from tagmetry.live.show.watch import BEAT_S
from tagmetry.pipeline.arena_twin.ready.stage import FLOOR_HALF_M

SIGN_IN, TOO_MANY, NOT_UNDERSTOOD = 4401, 1013, 1008  # why a socket is closed
_PATIENCE_S = 5.0  # for a page to take one message
_MOST_REFUSALS = 20


class Pages:
    """Serves every page until it is gone."""

    def __init__(
        self, access: Access, hub: Hub, runner: Runner, rooms: Sequence[Room] = ()
    ) -> None:
        self._access, self._hub, self._runner = access, hub, runner
        self._takers = {kind: take for room in rooms for kind, take in room.takers.items()}

    async def serve(self, socket: WebSocket) -> None:
        """Serve one page."""
        await socket.accept()
        role = self._access.role(socket.cookies.get(self._access.cookie))
        if role is None:
            await socket.close(SIGN_IN, "sign in with the token")
            return
        try:
            slot = self._hub.join()
        except InputError as error:
            await socket.close(TOO_MANY, str(error))
            return
        await self._until_gone(socket, slot, role)

    async def _until_gone(self, socket: WebSocket, slot: Slot, role: Role) -> None:
        page = slot.page
        self._runner.viewers = self._hub.pages
        slot.first(self._welcome(role))
        both = {
            asyncio.create_task(_tell(socket, slot)),
            asyncio.create_task(self._hear(socket, slot, page, role)),
        }
        try:
            await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
        finally:
            self._runner.leave(page)
            self._hub.leave(slot)
            self._runner.viewers = self._hub.pages
            for task in both:
                task.cancel()
            await asyncio.gather(*both, return_exceptions=True)

    def _welcome(self, role: Role) -> str:
        return format_message(Welcome(role, self._runner.scenarios, FLOOR_HALF_M, BEAT_S))

    async def _hear(self, socket: WebSocket, slot: Slot, page: int, role: Role) -> None:
        """Do what the page asks until it goes, or makes no sense too often."""
        refusals = 0
        while refusals < _MOST_REFUSALS:
            message = await socket.receive()
            if message["type"] == "websocket.disconnect":
                return
            try:
                self._give(page, slot, _asked(message.get("text"), role))
            except InputError as error:
                refusals += 1
                slot.put("Refused", format_message(Refused(str(error))))
        await socket.close(NOT_UNDERSTOOD, "too many messages were refused")

    def _give(self, page: int, slot: Slot, asked: Asked) -> None:
        """Give what a page asks for to its room; the arena takes what no room does."""
        take = self._takers.get(type(asked))
        if isinstance(asked, Seen):
            slot.shown(Picture.__name__)
            self._hub.delays.count(time.monotonic() - asked.taken_s)
        elif take is None:
            self._runner.ask(page, asked)
        else:
            take(asked)


def _asked(text: str | None, role: Role) -> Asked:
    if text is None:
        raise InputError("expected a message as text, got bytes")
    return parse_asked(text, role)


async def _tell(socket: WebSocket, slot: Slot) -> None:
    """Send what comes until the page takes too long for one message, or is gone."""
    async for frame in slot.frames():
        async with asyncio.timeout(_PATIENCE_S):
            if isinstance(frame, str):
                await socket.send_text(frame)
            else:
                await socket.send_bytes(frame)

"""The live page's server: the page itself, the sign-in, and one socket for all messages.

Every route is declared in `ROUTES` with the role that it needs; a test holds the app against it.
"""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from contextlib import asynccontextmanager

from fastapi import FastAPI, Request, Response
from starlette.requests import ClientDisconnect

from tagmetry.live.messages import Role
from tagmetry.live.page import PARTS, Part
from tagmetry.live.rooms.room import Room, words
from tagmetry.live.running import Runner
from tagmetry.live.server.access import Access
from tagmetry.live.server.delivery import tell_delivery
from tagmetry.live.server.door import behind
from tagmetry.live.server.guard import Guard
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.pages import Pages

_MOST_BODY_BYTES = 512
_PATIENCE_S = 5.0  # for a whole body

ROUTES: dict[str, tuple[str, Role | None]] = {  # path: method and role; None: anybody
    **dict.fromkeys(PARTS, ("GET", None)),
    "/sign-in": ("POST", None),
    "/recordings": ("GET", "operator"),
    "/recordings/{name}": ("GET", "operator"),
    "/recordings/{name}/delete": ("POST", "operator"),
    "/recordings/{name}/length": ("GET", "operator"),
    "/recordings/{name}/world": ("GET", "operator"),
    "/recordings/{name}/picture": ("GET", "operator"),
    "/print/choices": ("GET", "viewer"),
    "/print/preview": ("GET", "viewer"),
    "/print/sheet.pdf": ("GET", "viewer"),
    "/print/sheet.svg": ("GET", "viewer"),
    "/calibrate/report": ("GET", "viewer"),
    "/lens/bank": ("GET", "viewer"),
    "/live": ("WEBSOCKET", "viewer"),
}


def create_app(access: Access, hub: Hub, runner: Runner, rooms: Sequence[Room] = ()) -> FastAPI:
    """Return the server.

    Args:
        access: Says who may do what.
        hub: Tells the pages.
        runner: Does what they ask of the arena.
        rooms: Do what they ask of the other rooms.
    """

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        hub.open()
        telling = asyncio.create_task(tell_delivery(hub))
        yield
        telling.cancel()
        hub.close()

    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None, lifespan=lifespan)
    app.add_middleware(Guard, access=access)
    for path, part in PARTS.items():
        app.add_api_route(path, _shown(part), methods=["GET"])
    for room in rooms:
        _add(app, access, room)
    app.add_api_route("/sign-in", _sign_in(access), methods=["POST"])
    app.add_api_websocket_route("/live", Pages(access, hub, runner, rooms).serve)
    return app


def _add(app: FastAPI, access: Access, room: Room) -> None:
    """Let a room answer, each request for those who may ask it."""
    for path, answer in room.answers.items():
        method, role = ROUTES[path]
        app.add_api_route(path, behind(access, role, answer), methods=[method], response_model=None)


def _shown(part: Part) -> Callable[[], Response]:
    def show() -> Response:
        return Response(part.content, media_type=part.kind)

    return show


def _sign_in(access: Access) -> Callable[[Request], Awaitable[Response]]:
    async def sign_in(request: Request) -> Response:
        body = await _body(request)
        if body is None:
            return words("expected the token alone", 413)
        session = access.sign_in(body)
        if session is None:
            await asyncio.sleep(0.2)
            return words("this is not the token", 403)
        answer = Response(status_code=204)
        answer.set_cookie(access.cookie, session, httponly=True, samesite="strict", path="/")
        return answer

    return sign_in


async def _body(request: Request) -> str | None:
    """Return a short body; None for one that is too long, too slow or no text."""
    read = bytearray()
    try:
        async with asyncio.timeout(_PATIENCE_S):
            async for piece in request.stream():
                read += piece
                if len(read) > _MOST_BODY_BYTES:
                    return None
        return read.decode("ascii").strip()
    except (TimeoutError, UnicodeDecodeError, ClientDisconnect):
        return None

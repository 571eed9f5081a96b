"""Answers of the room of recordings; all of them for operators."""

from collections.abc import Callable
from math import isfinite
from pathlib import Path

from fastapi import Request, Response
from fastapi.responses import FileResponse, JSONResponse

from tagmetry.errors import InputError
from tagmetry.live.rooms.recordings.replays import Replays
from tagmetry.live.rooms.recordings.shelf import Shelf
from tagmetry.live.rooms.room import Answer, Room, words
from tagmetry.live.rooms.turns import Turns
from tagmetry.live.running import Runner

_MOST_WAITING = 16
_BINARY, _JSON = "application/octet-stream", "application/json"

Read = Callable[[Path, float], Response]


def recordings_room(runner: Runner) -> Room:
    """Return the room.

    Args:
        runner: Says where recordings are, and which one is being written.
    """
    shelf = Shelf(lambda: runner.recordings, lambda: runner.recording)
    replays = Replays()
    turns = Turns(_MOST_WAITING, "too many moments are asked for at once; try again")
    world, picture = _told(replays.world, _JSON), _told(replays.picture, _BINARY)
    return Room(
        answers={
            "/recordings": _shown(shelf),
            "/recordings/{name}": _fetched(shelf),
            "/recordings/{name}/delete": _deleted(shelf),
            "/recordings/{name}/length": turns.answer(_read(shelf, _length(replays))),
            "/recordings/{name}/world": turns.answer(_read(shelf, world)),
            "/recordings/{name}/picture": turns.answer(_read(shelf, picture)),
        }
    )


def _shown(shelf: Shelf) -> Answer:
    async def show(_: Request) -> Response:
        return JSONResponse(shelf.all())

    return show


def _fetched(shelf: Shelf) -> Answer:
    async def fetch(request: Request) -> Response:
        path = shelf.path(request.path_params["name"])
        if path is None:
            return _nothing()
        return FileResponse(path, media_type=_BINARY, filename=path.name)

    return fetch


def _deleted(shelf: Shelf) -> Answer:
    async def delete(request: Request) -> Response:
        try:
            was_there = shelf.delete(request.path_params["name"])
        except InputError as error:
            return words(str(error), 409)
        return Response(status_code=204) if was_there else _nothing()

    return delete


def _read(shelf: Shelf, read: Read) -> Callable[[Request], Response]:
    def answer(request: Request) -> Response:
        path = shelf.whole(request.path_params["name"])
        return _nothing() if path is None else read(path, _at_s(request))

    return answer


def _length(replays: Replays) -> Read:
    def read(path: Path, _: float) -> Response:
        return JSONResponse({"length_s": replays.length_s(path)})

    return read


def _told(find: Callable[[Path, float], bytes | None], kind: str) -> Read:
    def read(path: Path, at_s: float) -> Response:
        content = find(path, at_s)
        return Response(status_code=204) if content is None else Response(content, media_type=kind)

    return read


def _at_s(request: Request) -> float:
    """Return the moment that is asked for, the beginning where none is.

    Raises:
        InputError: It is no number.
    """
    text = request.query_params.get("at", "0")[:40]
    try:
        at_s = float(text)
    except ValueError:
        at_s = float("nan")
    if not isfinite(at_s):
        raise InputError(f"expected `at` in seconds since the recording began, got {text!r}")
    return at_s


def _nothing() -> Response:
    return words("there is no such recording", 404)

"""What a room of the page has of the server: answers to requests, takers of messages."""

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field

from fastapi import Request, Response

from tagmetry.live.messages import Asked

Answer = Callable[[Request], Awaitable[Response]]
Take = Callable[[Asked], None]  # returns at once; raises InputError for what it refuses


def words(text: str, status: int) -> Response:
    """Return an answer in words."""
    return Response(text, status, media_type="text/plain")


def _nothing() -> None:
    """Do nothing: many rooms have nothing to end."""


@dataclass(frozen=True)
class Room:
    """A room behind the door.

    Attributes:
        answers: What answers each path; `tagmetry.live.server.app.ROUTES` says who may ask.
        takers: What takes each message; `tagmetry.live.messages.CONTRACT` says who may send it.
        close: Ends what runs in the room.
    """

    answers: Mapping[str, Answer] = field(default_factory=dict)
    takers: Mapping[type[Asked], Take] = field(default_factory=dict)
    close: Callable[[], None] = _nothing

"""A live page's robots in a program or a notebook: where they are, what the camera sees, commands.

A client that has driven counts as there while it is open: it says so by itself. When it is closed,
when its program ends or the connection breaks, all robots stop.
"""

import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack
from typing import TypeVar

import cv2
import numpy as np

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.live.client.asking import Asking
from tagmetry.live.client.knocking import opened
from tagmetry.live.client.mailbox import Mailbox
from tagmetry.live.client.reading import parse_told
from tagmetry.live.messages import (
    CONTRACT,
    Asked,
    Beat,
    FloorErrors,
    Health,
    MeasureErrors,
    Picture,
    Refused,
    Seen,
    Stage,
    Told,
    Welcome,
    World,
)
from tagmetry.live.messages.wire import format_message

_ROLES = {rule.message: rule.role for rule in CONTRACT}
_PATIENCE_S = 10.0
_Kind = TypeVar("_Kind", bound=Told)


class LiveClient(Asking, Closing):
    """A connection to a live page's server; to be used in a with-block, or closed.

    Attributes:
        welcome: Who this client is, and what there is.
    """

    def __init__(self, url: str, token: str | None = None) -> None:
        """Connect.

        Args:
            url: As `tagmetry live` printed it.
            token: That it printed; without one the client looks, and may stop.

        Raises:
            InputError: Nobody answers there, or this is not the token.
            MissingExtraError: The extra `live` is not installed.
        """
        self._open = ExitStack()
        self._socket = opened(self._open, url, token)
        self._mail = Mailbox()
        self._thread = threading.Thread(target=self._run, name="live client", daemon=True)
        self._thread.start()
        try:
            self.welcome = self._newest(Welcome)
        except InputError:
            self.close()
            raise

    def close(self) -> None:
        """End the connection; robots stop if this client drove them."""
        self._open.close()
        self._thread.join(_PATIENCE_S)

    @property
    def world(self) -> World:
        """Where all robots are, as was told last."""
        return self._newest(World)

    @property
    def stage(self) -> Stage:
        """Obstacles, fence and parameters."""
        return self._newest(Stage)

    @property
    def health(self) -> Health:
        """How the measurement does; `notice` says why a command was not done."""
        return self._newest(Health)

    @property
    def refused(self) -> str:
        """Why the last message that made no sense was refused; empty before one was."""
        told = self._mail.newest(Refused)
        return told.why if told is not None else ""

    def worlds(self, seconds: float = float("inf")) -> Iterator[World]:
        """Yield where all robots are, each time anew; a slow reader gets the newest.

        Args:
            seconds: For how long.

        Raises:
            InputError: The connection has ended.
        """
        yield from self._each(World, seconds)

    def pictures(self, seconds: float = float("inf")) -> Iterator[tuple[Picture, AnyPixels]]:
        """Yield what the camera sees, with the picture as an array, uint8.

        Args:
            seconds: For how long.

        Raises:
            InputError: The connection has ended.
        """
        for picture in self._each(Picture, seconds):
            jpeg = np.frombuffer(picture.jpeg, np.uint8)
            yield picture, np.asarray(cv2.imdecode(jpeg, cv2.IMREAD_UNCHANGED))

    def measure_errors(self, seconds: float = 120.0) -> FloorErrors:
        """Return the simulated floor's error map once it is measured.

        Args:
            seconds: To wait at most.

        Raises:
            InputError: It was not there in time, or the connection has ended.
        """
        count = self._mail.count(FloorErrors)
        self.send(MeasureErrors())
        end_s = time.monotonic() + seconds
        while (found := self._mail.after(FloorErrors, count, end_s - time.monotonic())) is not None:
            count, errors = found
            if not errors.is_measuring:
                return errors
        raise InputError(f"the error map was not there after {seconds:g} s")

    def send(self, asked: Asked) -> None:
        """Send any message of a page.

        Args:
            asked: What to ask for.

        Raises:
            InputError: It needs the token, or the connection has ended.
        """
        if _ROLES[type(asked)] == "operator" and self.welcome.role != "operator":
            raise InputError(f"{type(asked).__name__} needs the token; give it to LiveClient")
        from websockets.exceptions import ConnectionClosed

        try:
            self._socket.send(format_message(asked))
        except ConnectionClosed as error:
            raise InputError(f"the connection to the live page has ended: {error}") from error

    def _newest(self, kind: type[_Kind]) -> _Kind:
        found = self._mail.after(kind, 0, _PATIENCE_S)
        if found is None:
            raise InputError(f"the live page's server told no {kind.__name__} yet")
        return found[1]

    def _each(self, kind: type[_Kind], seconds: float) -> Iterator[_Kind]:
        end_s, count = time.monotonic() + seconds, 0
        while (left_s := end_s - time.monotonic()) > 0:
            found = self._mail.after(kind, count, min(left_s, _PATIENCE_S))
            if found is not None:
                count, message = found
                yield message

    def _run(self) -> None:
        """Take what comes, and say that this client is there, until the connection ends."""
        from websockets.exceptions import ConnectionClosed

        due_s = time.monotonic()
        try:
            while True:
                self._take(max(due_s - time.monotonic(), 0.0))
                if time.monotonic() >= due_s:
                    due_s = time.monotonic() + self._beat()
        except (ConnectionClosed, InputError) as error:
            self._mail.end(f"the connection to the live page has ended: {error}")

    def _take(self, seconds: float) -> None:
        try:
            message = parse_told(self._socket.recv(timeout=seconds))
        except TimeoutError:
            return
        if message is not None:
            self._mail.put(message)
        if isinstance(message, Picture):
            self._socket.send(format_message(Seen(message.taken_s)))

    def _beat(self) -> float:
        """Say that this client is there; return in how long to say so again."""
        welcome = self._mail.newest(Welcome)
        if welcome is None:
            return 0.01
        if welcome.role == "operator":
            self._socket.send(format_message(Beat()))
        return welcome.beat_s

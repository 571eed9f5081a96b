"""The arena's end of the net: tells other computers what it sees, and takes what they command.

The arena's own thread tells; the bridge's thread answers those that look on and those that command,
however busy the arena is.
"""

import secrets
import threading
import time
from collections.abc import Mapping
from typing import Self

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.link.computers.broadcast import Broadcast
from tagmetry.link.computers.inbox import Inbox
from tagmetry.link.computers.keys import ARENA_ID, OPEN_KEY
from tagmetry.link.computers.net import Net
from tagmetry.link.computers.stand_ins import StandIns
from tagmetry.link.computers.topics import Topics, checked_name
from tagmetry.link.host import now_us
from tagmetry.link.messages import (
    KINDS,
    ArenaState,
    Beat,
    Command,
    Neighbours,
    PackedNeighbours,
    State,
)

_LOOK_S = 0.002
_BEAT_US = 50_000
_MOST_AT_ONCE = 256
_KEPT = 2000  # of a flood; what is dropped is said again


class ArenaBridge(Closing):
    """Tells other computers of an arena, and hears them; to be used in a with-block."""

    def __init__(
        self,
        arena: str,
        robots: Mapping[int, str],
        *,
        listen: str | None = None,
        connect: str | None = None,
        view_key: bytes = OPEN_KEY,
        command_key: bytes | None = None,
    ) -> None:
        """Join the net; nothing is told before the with-block.

        Args:
            arena: Its name.
            robots: Its robots' names by id.
            listen: Where other computers reach this one: tcp/192.168.1.5:7447.
            connect: A router that they meet at instead, or as well.
            view_key: Of those who look on; by default they need none, and cannot tell a forgery.
            command_key: Of those who command robots; nobody does where it is None.

        Raises:
            InputError: A name cannot be told, or there is no such endpoint.
            MissingExtraError: Zenoh is not installed.
        """
        self._topics = Topics(arena)
        self._names = _checked_names(robots)
        self._broadcast = Broadcast(view_key, lambda: secrets.randbits(64))
        obeying = () if command_key is None else tuple(robots)
        self._stand_ins = StandIns(obeying, command_key or b"", lambda: secrets.randbits(64))
        self._obeying = frozenset(obeying)
        self._lock = threading.Lock()
        self._is_closing = threading.Event()
        self._inboxes: list[Inbox] = []
        self._thread = threading.Thread(target=self._run, name="bridge", daemon=True)
        self._net = Net(listen, connect)

    def __enter__(self) -> Self:
        topics = [self._topics.hello]
        topics += [self._topics.command()] if self._obeying else []
        self._inboxes = [self._net.inbox(topic, _KEPT) for topic in topics]
        self._thread.start()
        return self

    def close(self) -> None:
        """Fall silent."""
        self._is_closing.set()
        self._thread.join()
        self._net.close()

    @property
    def is_obeying(self) -> bool:
        """Whether other computers may command robots."""
        return bool(self._obeying)

    @property
    def is_stopped(self) -> bool:
        """Whether another computer has pressed the emergency stop, and none has released it."""
        with self._lock:
            return self._stand_ins.is_stopped

    def command(self, robot_id: int) -> Command | None:
        """Return what another computer commands a robot; None where none commands it."""
        if robot_id not in self._obeying:
            return None
        with self._lock:
            return self._stand_ins.command(robot_id, now_us())

    def tell(self, robot_id: int, message: State | Neighbours | PackedNeighbours | Command) -> None:
        """Tell all what is known of a robot.

        Raises:
            InputError: The message holds what cannot be sent.
        """
        packet = self._broadcast.seal(robot_id, message, now_us())
        self._net.tell(self._topics.of(KINDS[type(message)], self._names[robot_id]), packet)

    def tell_image(self, message: ArenaState) -> None:
        """Tell all that the states of one image are complete."""
        self._net.tell(self._topics.state, self._broadcast.seal(ARENA_ID, message, now_us()))

    def _run(self) -> None:
        next_us = now_us()
        while not self._is_closing.is_set():
            time.sleep(_LOOK_S)
            for inbox in self._inboxes:
                for topic, packet in inbox.all(_MOST_AT_ONCE):  # leaves time in a flood
                    self._hear(topic, packet)
            if now_us() >= next_us:
                next_us = now_us() + _BEAT_US
                self._say_what_is_due()

    def _hear(self, topic: str, packet: bytes) -> None:
        if topic != self._topics.hello:
            with self._lock:
                self._stand_ins.hear(packet, now_us())
            return
        answer = self._broadcast.answer(packet, now_us())
        if answer is not None:
            self._net.tell(self._topics.assign, answer)

    def _say_what_is_due(self) -> None:
        self._net.tell(self._topics.assign, self._broadcast.seal(ARENA_ID, Beat(), now_us()))
        with self._lock:
            due = self._stand_ins.due(now_us())
        for robot_id, packet in due:
            self._net.tell(self._topics.answer(self._names[robot_id]), packet, is_urgent=True)


def _checked_names(robots: Mapping[int, str]) -> dict[int, str]:
    names = {key: checked_name(name, "robot") for key, name in robots.items()}
    beyond = [key for key in names if not 0 <= key < ARENA_ID]
    if beyond:
        raise InputError(f"other computers tell robots by ids from 0 to 65534, got {beyond[0]}")
    said = list(names.values())
    twice = [name for name in said if said.count(name) > 1]
    if twice:
        raise InputError(f"other computers tell robots by name, and two are called {twice[0]!r}")
    return names

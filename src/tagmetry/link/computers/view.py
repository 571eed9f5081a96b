"""An arena seen from another computer.

Packets come faster than a busy program reads them. They wait in a ring, where the oldest make room
for the newest, until the program looks; then only the newest image that is whole is read.
"""

import secrets
import threading
import time
from collections.abc import Callable
from typing import Self

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.link.computers.inbox import Inbox, Packet
from tagmetry.link.computers.keys import ARENA_ID, OPEN_KEY
from tagmetry.link.computers.net import Net
from tagmetry.link.computers.onlooker import Onlooker
from tagmetry.link.computers.sight import ArenaSight, Gathering
from tagmetry.link.computers.topics import Topics, is_told, robot_of
from tagmetry.link.host import now_us
from tagmetry.link.layout import Sender
from tagmetry.link.messages import ArenaState
from tagmetry.link.packet import Refusal
from tagmetry.link.wire import KEY_BYTES

_SILENCE_US = 500_000
_MOST_UNREAD = 2000  # packets; three images of 200 robots
_LOOK_S = 0.001


class ArenaView(Closing):
    """Looks on; to be used in a with-block.

    Only the newest image is kept, so that a program that is slow sees fewer, and none late.
    """

    def __init__(
        self,
        endpoint: str,
        arena: str = "arena",
        key: bytes = OPEN_KEY,
        *,
        clock: Callable[[], int] = now_us,
    ) -> None:
        """Connect; what is seen comes a moment later.

        Args:
            endpoint: The arena's computer, or a router: tcp/192.168.1.5:7447.
            arena: The arena's name, as its file has it.
            key: That of its file to look on with, as `parse_key` returns it; none where that has
                none.
            clock: Microseconds that only rise.

        Raises:
            InputError: Nobody answers there, or the name or the key cannot be one.
            MissingExtraError: Zenoh is not installed.
        """
        if len(key) != KEY_BYTES:
            raise InputError(f"expected a key of {KEY_BYTES} bytes, got {len(key)}; see parse_key")
        self._topics, self._clock = Topics(arena), clock
        self._onlooker = Onlooker(key, lambda: secrets.randbits(64))
        self._gathering = Gathering()
        self._lock = threading.Lock()
        self._unread: list[Packet] = []
        self._inbox: Inbox | None = None
        self._newest: ArenaSight | None = None
        self._was_given = True
        self._heard_us: int | None = None
        self._net = Net(connect=endpoint)

    def __enter__(self) -> Self:
        self._net.hear([self._topics.assign], self._hear)
        self._inbox = self._net.inbox(self._topics.everything, _MOST_UNREAD)
        self._ask()
        return self

    def close(self) -> None:
        """Look away."""
        self._net.close()

    @property
    def newest(self) -> ArenaSight | None:
        """What is seen now; None before the first image."""
        with self._lock:
            self._look()
            return self._newest

    @property
    def is_heard(self) -> bool:
        """Whether the arena was heard in the last half second; else it has died, or the way to it.

        It is heard between images too, so that a camera that is slow or lost shows in `age_s`.
        """
        heard_us = self._heard_us
        return heard_us is not None and self._clock() - heard_us < _SILENCE_US

    @property
    def age_s(self) -> float:
        """How old the newest image's moment is, at most; infinite before the first."""
        newest = self.newest
        if newest is None:
            return float("inf")
        return self._onlooker.host_us(self._clock()) / 1e6 - newest.world.time_s

    @property
    def refused(self) -> dict[Refusal, int]:
        """How many packets were refused, and why."""
        return dict(self._onlooker.refused)

    def wait(self, timeout_s: float = 0.5) -> ArenaSight | None:
        """Return the newest image that was not returned yet, waiting for it; None if none comes."""
        end_s = time.monotonic() + timeout_s
        while True:
            self._ask()
            sight = self._news()
            rest_s = end_s - time.monotonic()
            if sight is not None or rest_s <= 0:
                return sight
            time.sleep(min(_LOOK_S, rest_s))

    def _news(self) -> ArenaSight | None:
        with self._lock:
            self._look()
            if self._was_given:
                return None
            self._was_given = True
            return self._newest

    def _hear(self, _topic: str, packet: bytes) -> None:
        """Take an answer or a beat, in a thread of the net."""
        now = self._clock()
        with self._lock:
            if self._onlooker.hear(packet, "host", now) is not None:
                self._heard_us = now
        self._ask()

    def _look(self) -> None:
        """Read the newest image that has come whole since the last look."""
        if self._inbox is None:
            return
        end = self._topics.state
        came = [one for one in self._inbox.all(_MOST_UNREAD) if one[0] == end or is_told(one[0])]
        self._unread = [*self._unread, *came][-_MOST_UNREAD:]
        ends = [n for n, (topic, _) in enumerate(self._unread) if topic == end]
        for number in reversed(range(len(ends))):
            begin = ends[number - 1] + 1 if number else 0
            if self._read(self._unread[begin : ends[number]], self._unread[ends[number]][1]):
                break
        self._unread = self._unread[ends[-1] + 1 :] if ends else self._unread

    def _read(self, packets: list[Packet], end: bytes) -> bool:
        """Read the packets of one image, if its end is genuine; say whether it is."""
        now = self._clock()
        heard = self._onlooker.hear(end, "arena", now)
        if heard is None or not isinstance(heard[1], ArenaState):
            return False
        for topic, packet in packets:
            sender: Sender = "arena" if topic.endswith("/pose") else "host"
            told = self._onlooker.hear(packet, sender, now)
            if told is not None:
                self._gathering.add(told[0], robot_of(topic), told[1])
        self._newest = self._gathering.add(ARENA_ID, "", heard[1])
        self._heard_us, self._was_given = now, False
        return True

    def _ask(self) -> None:
        with self._lock:
            hello = self._onlooker.due(self._clock())
        if hello is not None:
            self._net.tell(self._topics.hello, hello)

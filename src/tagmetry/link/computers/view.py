"""An arena seen from another computer.

Packets come faster than a busy program reads them. So those about robots are laid aside unread, and
once the end of their image has come they replace those of the image before. Whoever asks reads the
newest image; nobody reads the others.
"""

import secrets
import threading
from collections import deque
from collections.abc import Callable
from typing import Self

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.link.computers.keys import ARENA_ID, OPEN_KEY
from tagmetry.link.computers.net import Net
from tagmetry.link.computers.onlooker import Onlooker
from tagmetry.link.computers.sight import ArenaSight, Gathering
from tagmetry.link.computers.topics import Topics, robot_of
from tagmetry.link.host import now_us
from tagmetry.link.layout import Sender
from tagmetry.link.messages import ArenaState
from tagmetry.link.packet import Refusal
from tagmetry.link.wire import KEY_BYTES

Laid = tuple[str, bytes, int]  # topic, packet, when it came

_SILENCE_US = 500_000
_MOST_LAID = 10_000


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
        self._changed = threading.Condition()
        self._coming: deque[Laid] = deque(maxlen=_MOST_LAID)
        self._whole: tuple[tuple[Laid, ...], ArenaState] | None = None
        self._newest: ArenaSight | None = None
        self._was_given = True
        self._heard_us: int | None = None
        self._net = Net(connect=endpoint)

    def __enter__(self) -> Self:
        self._net.hear(self._topics.told(), self._hear)
        self._ask()
        return self

    def close(self) -> None:
        """Look away."""
        self._net.close()

    @property
    def newest(self) -> ArenaSight | None:
        """What is seen now; None before the first image."""
        with self._changed:
            self._read()
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
        self._ask()
        with self._changed:
            self._changed.wait_for(self._has_news, timeout_s)
            self._read()
            if self._was_given:
                return None
            self._was_given = True
            return self._newest

    def _has_news(self) -> bool:
        return self._whole is not None or not self._was_given

    def _hear(self, topic: str, packet: bytes) -> None:
        """Take a packet, in a thread of the net."""
        now = self._clock()
        if topic == self._topics.state:
            self._hear_of_image(packet, now)
        elif topic == self._topics.assign:
            self._hear_of_session(packet, now)
            self._ask()
        else:
            self._coming.append((topic, packet, now))

    def _hear_of_session(self, packet: bytes, now: int) -> None:
        with self._changed:
            if self._onlooker.hear(packet, "host", now) is not None:
                self._heard_us = now

    def _hear_of_image(self, packet: bytes, now: int) -> None:
        """Replace what was laid aside of an older image, where this end of one is genuine."""
        with self._changed:
            heard = self._onlooker.hear(packet, "arena", now)
            if heard is not None and isinstance(heard[1], ArenaState):
                self._heard_us = now
                self._whole = tuple(self._coming), heard[1]
                self._coming.clear()
                self._changed.notify_all()

    def _read(self) -> None:
        """Read the packets of the newest image, where that was not done yet."""
        if self._whole is None:
            return
        packets, end = self._whole
        self._whole = None
        for topic, packet, came_us in packets:
            sender: Sender = "arena" if topic.endswith("/pose") else "host"
            heard = self._onlooker.hear(packet, sender, came_us)
            if heard is not None:
                self._gathering.add(heard[0], robot_of(topic), heard[1])
        self._newest = self._gathering.add(ARENA_ID, "", end)
        self._was_given = False

    def _ask(self) -> None:
        with self._changed:
            hello = self._onlooker.due(self._clock())
        if hello is not None:
            self._net.tell(self._topics.hello, hello)

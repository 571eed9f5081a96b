"""An arena seen from another computer."""

import secrets
import threading
from collections.abc import Callable
from typing import Self

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.link.computers.keys import OPEN_KEY
from tagmetry.link.computers.net import Net
from tagmetry.link.computers.onlooker import Onlooker
from tagmetry.link.computers.sight import ArenaSight, Gathering
from tagmetry.link.computers.topics import Topics, robot_of
from tagmetry.link.host import now_us
from tagmetry.link.layout import Sender
from tagmetry.link.packet import Refusal
from tagmetry.link.wire import KEY_BYTES

_SILENCE_US = 500_000


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
        if self._newest is None:
            return float("inf")
        return self._onlooker.host_us(self._clock()) / 1e6 - self._newest.world.time_s

    @property
    def refused(self) -> dict[Refusal, int]:
        """How many packets were refused, and why."""
        return dict(self._onlooker.refused)

    def wait(self, timeout_s: float = 0.5) -> ArenaSight | None:
        """Return the newest image that was not returned yet, waiting for it; None if none comes."""
        self._ask()
        with self._changed:
            self._changed.wait_for(lambda: not self._was_given, timeout_s)
            if self._was_given:
                return None
            self._was_given = True
            return self._newest

    def _hear(self, topic: str, packet: bytes) -> None:
        """Take a packet, in a thread of the net."""
        now = self._clock()
        sender: Sender = "arena" if topic.endswith(("/state", "/pose")) else "host"
        with self._changed:
            heard = self._onlooker.hear(packet, sender, now)
            if heard is not None:
                self._heard_us = now
                robot_id, message = heard
                self._see(self._gathering.add(robot_id, robot_of(topic), message))
        self._ask()

    def _see(self, sight: ArenaSight | None) -> None:
        if sight is not None:
            self._newest, self._was_given = sight, False
            self._changed.notify_all()

    def _ask(self) -> None:
        with self._changed:
            hello = self._onlooker.due(self._clock())
        if hello is not None:
            self._net.tell(self._topics.hello, hello)

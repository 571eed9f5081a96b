"""The net of computers: Zenoh over TCP, to the endpoints that are named and to no others.

Nobody is looked for, by multicast or by hearsay, and nothing waits: what a slow computer does not
take is dropped on its way to it.
"""

import json
import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from tagmetry.closing import Closing
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.link.computers.inbox import Inbox
from tagmetry.link.wire import MOST_BYTES

if TYPE_CHECKING:
    from zenoh import Session

Take = Callable[[str, bytes], None]

_ENDPOINT = re.compile(r"tcp/(\[[0-9a-fA-F:.%]+\]|[\w.-]+):(\d{1,5})")
_REASON = re.compile(r": ([A-Z][^:\[\]]*?) \(os error")
_BATCHES = 16  # of 64 KiB, that wait for a computer; then packets are dropped
_LONGEST_BYTES = 65_536  # a computer that sends more at once is cut off
_PATIENCE_MS = 2000  # until a computer answers


class Net(Closing):
    """A computer's place on the net."""

    def __init__(self, listen: str | None = None, connect: str | None = None) -> None:
        """Join.

        Args:
            listen: Where others reach this computer, such as tcp/192.168.1.5:7447; nowhere when
                None.
            connect: Another computer, or a router; none when None.

        Raises:
            InputError: An endpoint is none, is taken, or nobody answers there.
            MissingExtraError: Zenoh is not installed.
        """
        for endpoint in (listen, connect):
            _check_endpoint(endpoint)
        try:
            import zenoh
        except ImportError as error:
            raise MissingExtraError("talking to other computers", "zenoh") from error
        self._session = _opened(listen, connect)
        self._closed = zenoh.ZError
        self._dropping = {"congestion_control": zenoh.CongestionControl.DROP}
        self._urgent = {"priority": zenoh.Priority.REAL_TIME}

    def tell(self, topic: str, packet: bytes, *, is_urgent: bool = False) -> bool:
        """Publish a packet; say whether it left. Urgent ones overtake others."""
        how = self._dropping | self._urgent if is_urgent else self._dropping
        try:
            self._session.put(topic, packet, **how)
        except self._closed:
            return False
        return True

    def hear(self, topics: Sequence[str], take: Take) -> None:
        """Hand topic and content of few packets on, from threads of the net; `take` never waits.

        What is longer than any packet is passed over, so that nobody fills a queue with it.
        """
        from zenoh import Sample
        from zenoh.handlers import Callback

        def hand_on(sample: Sample) -> None:
            if len(sample.payload) <= MOST_BYTES:
                take(str(sample.key_expr), bytes(sample.payload))

        for topic in topics:
            self._session.declare_subscriber(topic, Callback(hand_on, indirect=False))

    def inbox(self, topic: str, kept: int) -> Inbox:
        """Return where packets wait that are told from now on, at most so many."""
        from zenoh.handlers import RingChannel

        ring = self._session.declare_subscriber(topic, RingChannel(kept))
        return Inbox(ring, self._closed)

    def close(self) -> None:
        """Leave."""
        self._session.close()


def _check_endpoint(endpoint: str | None) -> None:
    if endpoint is None:
        return
    found = _ENDPOINT.fullmatch(endpoint)
    if found is None or not 0 < int(found[2]) <= 0xFFFF:
        raise InputError(f"expected an endpoint like tcp/192.168.1.5:7447, got {endpoint[:60]!r}")


def _opened(listen: str | None, connect: str | None) -> "Session":
    import zenoh

    settings: dict[str, object] = {
        "mode": "peer",
        "listen/endpoints": [listen] if listen is not None else [],
        "listen/exit_on_failure": True,
        "connect/endpoints": [connect] if connect is not None else [],
        "connect/exit_on_failure": True,
        "connect/timeout_ms": _PATIENCE_MS,
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/link/rx/max_message_size": _LONGEST_BYTES,
        "transport/link/tx/queue/size/real_time": _BATCHES,
        "transport/link/tx/queue/size/data": _BATCHES,
        "transport/link/tx/queue/congestion_control/drop/wait_before_drop": 0,
    }
    config = zenoh.Config()
    for name, value in settings.items():
        config.insert_json5(name, json.dumps(value))
    try:
        return zenoh.open(config)
    except zenoh.ZError as error:
        raise InputError(_refusal(str(error), listen, connect)) from error


def _refusal(said: str, listen: str | None, connect: str | None) -> str:
    """Return on one line why the net was not joined; the package tells it at length."""
    if connect is not None and "listener" not in said:
        return (
            f"nobody answers at {connect}; is the arena running there, and does its file say "
            "`zenoh: {listen: …}` with this port?"
        )
    found = _REASON.search(said)
    reason = found[1] if found is not None else "it is refused"
    return (
        f"cannot listen at {listen}: {reason}; end the other program, or name another port or an "
        "address of this computer"
    )

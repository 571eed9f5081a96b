"""The host's end of the link: one thread that hears all robots and never lets them wait.

The program sends from its own thread, and takes what was received when it likes. The link's thread
answers, repeats the emergency stop, and beats for a program that is alive: where that neither sends
nor pulses any more, the beats end, and every robot stops by itself.
"""

import secrets
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Self

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.link.carrier import Address, Carrier, Envelope
from tagmetry.link.emergency import Emergency
from tagmetry.link.hearing import Hearing
from tagmetry.link.layout import Kind
from tagmetry.link.messages import KINDS, Beat, Command, Hello, Message, Time
from tagmetry.link.packet import Refusal
from tagmetry.link.peer import Peer, RobotLink
from tagmetry.link.sockets import LOOPBACK, open_carrier
from tagmetry.link.traffic import Packet, Received
from tagmetry.link.wire import BEAT_US, BODIES, KEY_BYTES, PORT

OnPacket = Callable[[Packet], None]

_KEPT = 10_000  # messages that nobody takes
_MOST_AT_ONCE = 256
_SENT_ONE_BY_ONE, _SENT_AT_ONCE = 4, 32  # before the sender hears what has come meanwhile
_GATHER_S = 0.001  # where packets come thick, a few are heard at a time: threads change less often
_PATIENCE_US = 200_000  # with a program that neither sends nor pulses
_OWN = frozenset(one for one, kind in KINDS.items() if BODIES[kind].sender == "host")


def now_us() -> int:
    """Return the host's clock, `time.monotonic` in microseconds."""
    return time.monotonic_ns() // 1000


class Host(Closing):
    """Talks to robots; to be used in a with-block.

    Every robot has a key, and nobody without it is heard or obeyed.
    """

    def __init__(
        self,
        keys: Mapping[int, bytes],
        address: str = LOOPBACK,
        port: int = PORT,
        *,
        on_packet: OnPacket | None = None,
        carrier: Carrier | None = None,
    ) -> None:
        """Bind the socket; nothing is heard before the with-block.

        Args:
            keys: Each robot's id and key, as `parse_key` returns it.
            address: The interface that robots reach; only this computer unless another is named.
            port: The port; 0 for a free one.
            on_packet: Told of every packet that is sent or accepted, from the thread that does;
                it must return at once.
            carrier: What brings the packets, and is closed with the host; UDP where None.

        Raises:
            InputError: An id or a key cannot be used, or the port is taken.
        """
        _check_keys(keys)
        self._hearing = Hearing({key: _peer(key, keys[key]) for key in keys})
        self._carrier = carrier if carrier is not None else open_carrier(address, port)
        self._emergency = Emergency()
        self._on_packet = on_packet
        self._received: deque[Received] = deque(maxlen=_KEPT)
        self._lock = threading.RLock()
        self._hearer = threading.Lock()  # one thread hears at a time: in the packets' order
        self._sent_count = 0
        self._is_closing = threading.Event()
        self._pulse_us = now_us()
        self._thread = threading.Thread(target=self._run, name="link", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def close(self) -> None:
        """Fall silent: every robot stops by itself."""
        self._is_closing.set()
        self._thread.join()
        self._carrier.close()

    @property
    def address(self) -> Address:
        """Where robots reach it."""
        return self._carrier.address

    @property
    def is_stopped(self) -> bool:
        """Whether the emergency stop is latched."""
        return self._emergency.is_latched

    def send(self, robot_id: int, message: Message) -> bool:
        """Send a message to a robot at once.

        Returns:
            Whether it left: not where the robot is not linked, and no command while the emergency
            stop is latched.

        Raises:
            InputError: There is no such robot, a robot sends such messages itself, or the message
                holds what cannot be sent.
        """
        peer = self._peer(robot_id, message)
        self.pulse()
        self._hear_between()
        return self._send(peer, message)

    def send_all(self, messages: Sequence[tuple[int, Message]]) -> int:
        """Send messages to robots, given by id, in one go.

        Returns:
            How many left, as `send` tells it of each.

        Raises:
            InputError: As of `send`.
        """
        asked = [(self._peer(robot_id, message), message) for robot_id, message in messages]
        self.pulse()
        left = 0
        for first in range(0, len(asked), _SENT_AT_ONCE):
            left += self._send_some(asked[first : first + _SENT_AT_ONCE])
            self._hear_meanwhile()
        return left

    def pulse(self) -> None:
        """Say that the program is alive, where it has nothing to send."""
        self._pulse_us = now_us()

    def stop(self) -> None:
        """Stop all robots now, and keep them stopped: the emergency stop latches."""
        with self._lock:
            self._emergency.stop()
        self._beat()

    def release(self) -> None:
        """Let robots move again; also those that an earlier host had stopped."""
        with self._lock:
            self._emergency.release()
        self._beat()

    def take(self) -> list[Received]:
        """Return what was received since the last call, the newest 10,000 messages."""
        with self._lock:
            taken = list(self._received)
            self._received.clear()
        return taken

    def links(self) -> tuple[RobotLink, ...]:
        """Return how every robot's link does, by rising id."""
        with self._lock:
            now = now_us()
            return tuple(self._hearing.peers[key].link(now) for key in sorted(self._hearing.peers))

    def refused(self) -> dict[Refusal, int]:
        """Return how many packets were refused that named no robot of this host, and why."""
        with self._lock:
            return dict(self._hearing.refused)

    def _run(self) -> None:
        """Hear and beat until the end."""
        next_us = now_us()
        while not self._is_closing.is_set():
            if self._carrier.wait(max(next_us - now_us(), 0) / 1e6) and self._hear_in_turn() > 1:
                time.sleep(_GATHER_S)
            if now_us() >= next_us:
                next_us = now_us() + BEAT_US // 2
                self._beat()
                with self._lock:
                    self._emergency.count_down()

    def _hear_between(self) -> None:
        """Hear from the program's thread now and then: while it sends, the link's waits for it."""
        self._sent_count += 1
        if self._sent_count % _SENT_ONE_BY_ONE == 0:
            self._hear_meanwhile()

    def _hear_meanwhile(self) -> None:
        if self._hearer.acquire(blocking=False):
            try:
                self._hear_some()
            finally:
                self._hearer.release()

    def _hear_in_turn(self) -> int:
        with self._hearer:
            return self._hear_some()

    def _hear_some(self) -> int:
        """Hear what has arrived, but leave time for the beats in a flood; return how many."""
        found = self._carrier.read_some(_MOST_AT_ONCE)
        for packet, address in found:
            self._hear(packet, address)
        return len(found)

    def _hear(self, packet: bytes, address: Address) -> None:
        with self._lock:
            heard = self._hearing.hear(packet, address, now_us())
            if heard is None:
                return
            peer, received = heard
            if not isinstance(received.message, (Hello, Time)):  # those are the link's own
                self._received.append(received)
            reply = self._hearing.reply(received)
        self._tell(peer, KINDS[type(received.message)], packet, is_incoming=True)
        if reply is not None:
            kind, answer = reply
            self._write(peer, kind, answer, address)

    def _beat(self) -> None:
        """Repeat the emergency stop, and beat for robots that were sent nothing else."""
        now = now_us()
        urgent = self._emergency.message()
        is_alive = now - self._pulse_us < _PATIENCE_US
        for peer in self._hearing.peers.values():
            if urgent is not None:
                self._send(peer, urgent)
            elif is_alive and now - peer.sent_us >= BEAT_US // 2:
                self._send(peer, Beat())

    def _peer(self, robot_id: int, message: Message) -> Peer:
        """Return the robot that a message is for."""
        peer = self._hearing.peers.get(robot_id)
        if peer is None:
            raise InputError(f"there is no robot {robot_id}: only {sorted(self._hearing.peers)}")
        if type(message) not in _OWN:
            raise InputError(f"{type(message).__name__} is a message of robots, the host has none")
        return peer

    def _send(self, peer: Peer, message: Message) -> bool:
        with self._lock:
            sealed = self._sealed(peer, message)
        return sealed is not None and self._write(peer, KINDS[type(message)], *sealed)

    def _send_some(self, messages: Sequence[tuple[Peer, Message]]) -> int:
        with self._lock:
            sealed = [(*one, self._sealed(*one)) for one in messages]
        ready = [(peer, message, one) for peer, message, one in sealed if one is not None]
        left = self._carrier.write_all([one for _, _, one in ready])
        for (peer, message, (packet, _)), has_left in zip(ready, left, strict=True):
            if has_left:
                self._tell(peer, KINDS[type(message)], packet, is_incoming=False)
        return sum(left)

    def _sealed(self, peer: Peer, message: Message) -> Envelope | None:
        """Return a packet and its way; None where there is no way, or no command may go it."""
        if not peer.has_session or peer.address is None:
            return None
        if self.is_stopped and isinstance(message, Command):
            return None
        return peer.seal(message, now_us()), peer.address

    def _write(self, peer: Peer, kind: Kind, packet: bytes, address: Address) -> bool:
        """Send without the lock: both threads get their turn while the system is asked."""
        if not self._carrier.write(packet, address):
            return False
        self._tell(peer, kind, packet, is_incoming=False)
        return True

    def _tell(self, peer: Peer, kind: Kind, packet: bytes, *, is_incoming: bool) -> None:
        if self._on_packet is not None:
            with self._lock:
                self._on_packet(Packet(now_us() / 1e6, peer.robot_id, kind, is_incoming, packet))


def _peer(robot_id: int, key: bytes) -> Peer:
    return Peer(robot_id, key, lambda: secrets.randbits(64))


def _check_keys(keys: Mapping[int, bytes]) -> None:
    for robot_id, key in keys.items():
        if not 0 <= robot_id <= 0xFFFF:
            raise InputError(f"expected a robot's id, 0 to 65535, got {robot_id}")
        if len(key) != KEY_BYTES:
            raise InputError(
                f"expected {KEY_BYTES} bytes as the key of robot {robot_id}, got {len(key)}; "
                "make one with tagmetry.link.new_key() and read it with parse_key()"
            )
    if len(set(keys.values())) < len(keys):
        raise InputError("expected a key of its own for every robot, found one twice")

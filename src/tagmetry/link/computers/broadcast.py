"""The host's end of what all computers may hear: sealed, counted, and begun by a fresh number.

A computer that looks on says HELLO with a number of its own. The ASSIGN that answers it proves
which session is of today, and bounds the host's clock; both are those of a robot's link.
"""

import threading
from collections.abc import Callable

from tagmetry.link.bodies import pack_body, unpack_body
from tagmetry.link.computers.keys import ARENA_ID
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Assign, Hello, Message
from tagmetry.link.packet import Header, Refusal, body_of, is_sealed_with, read_header, seal
from tagmetry.link.session import Session


class Broadcast:
    """Seals packets for all; knows neither net nor clock."""

    def __init__(self, key: bytes, draw_nonce: Callable[[], int]) -> None:
        """Begin a session.

        Args:
            key: Of those who look on.
            draw_nonce: Draws random numbers of 64 bits.
        """
        self._key, self._draw_nonce = key, draw_nonce
        self._lock = threading.Lock()
        self._begin()

    def seal(self, robot_id: int, message: Message, now_us: int) -> bytes:
        """Return the next packet about a robot, or about none (`ARENA_ID`).

        Raises:
            InputError: The message holds what cannot be sent.
        """
        with self._lock:
            if robot_id not in self._sessions:
                self._sessions[robot_id] = Session(self._key, self._nonce & 0xFFFFFFFF, robot_id)
            elif self._sessions[robot_id].is_spent:
                self._begin()
                self._sessions[robot_id] = Session(self._key, self._nonce & 0xFFFFFFFF, robot_id)
            return self._sessions[robot_id].seal(message, now_us)

    def answer(self, packet: bytes, now_us: int) -> bytes | None:
        """Return the ASSIGN that answers a HELLO; None where it is none."""
        header = read_header(packet, "robot")
        if isinstance(header, Refusal) or not is_sealed_with(self._key, packet):
            return None
        hello = unpack_body(header.kind, body_of(packet))
        if header.robot != ARENA_ID or not isinstance(hello, Hello):
            return None
        _, body = pack_body(Assign(hello.robot_nonce, self._nonce, hello.robot_us))
        return seal(self._key, Header(Kind.ASSIGN, ARENA_ID, now_us, 0, 0), body)

    def _begin(self) -> None:
        self._nonce = self._draw_nonce()
        self._sessions: dict[int, Session] = {}

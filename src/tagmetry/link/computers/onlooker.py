"""The end of a computer that looks on, without net and clock: what it believes, and what not."""

from collections import Counter
from collections.abc import Callable

from tagmetry.link.bodies import pack_body
from tagmetry.link.client.clock import HostClock
from tagmetry.link.client.greeting import opened_assign
from tagmetry.link.computers.keys import ARENA_ID
from tagmetry.link.layout import Kind, Sender
from tagmetry.link.messages import Assign, Hello, Message
from tagmetry.link.packet import Header, Refusal, read_header, seal
from tagmetry.link.session import Session
from tagmetry.link.wire import HELLO_US, RELINK_US


class Onlooker:
    """Hears what an arena tells all; times are microseconds of this computer's own clock.

    Attributes:
        refused: How many packets were refused, and why.
    """

    def __init__(self, key: bytes, draw_nonce: Callable[[], int]) -> None:
        """Know nothing yet.

        Args:
            key: Of those who look on.
            draw_nonce: Draws random numbers of 64 bits.
        """
        self.refused: Counter[Refusal] = Counter()
        self._key, self._draw_nonce = key, draw_nonce
        self._nonce = draw_nonce()
        self._number: int | None = None
        self._sessions: dict[int, Session] = {}
        self._clock = HostClock(0, 0, 0)
        self._asked_us: int | None = None
        self._is_astray = True  # packets come that are of no session it knows

    def due(self, now_us: int) -> bytes | None:
        """Return the HELLO that is due; None for most calls."""
        pause_us = HELLO_US if self._is_astray else RELINK_US
        if self._asked_us is not None and now_us - self._asked_us < pause_us:
            return None
        self._asked_us = now_us
        _, body = pack_body(Hello(self._nonce, now_us))
        return seal(self._key, Header(Kind.HELLO, ARENA_ID, 0, 0, 0), body)

    def hear(self, packet: bytes, sender: Sender, now_us: int) -> tuple[int, Message] | None:
        """Return which robot a packet is about and what it says; None where it is refused.

        Args:
            packet: Header, body and tag.
            sender: The side that may say such things where it was heard.
            now_us: When.
        """
        header = read_header(packet, sender)
        if isinstance(header, Refusal):
            self.refused[header] += 1
            return None
        heard = self._open(packet, header, now_us)
        if not isinstance(heard, Refusal):
            return header.robot, heard
        if header.kind is not Kind.ASSIGN or heard is not Refusal.REPLAYED:
            self.refused[heard] += 1  # and not what another computer was answered
        return None

    def host_us(self, now_us: int) -> int:
        """Return the host's time, never earlier than it is; only once something was heard."""
        return self._clock.host_us(now_us)

    def _open(self, packet: bytes, header: Header, now_us: int) -> Message | Refusal:
        if header.kind is Kind.ASSIGN:
            return self._open_assign(packet, header, now_us)
        if header.session != self._number:
            self._is_astray = True
            return Refusal.SESSION
        known = self._sessions.get(header.robot)
        session = known or Session(self._key, header.session, header.robot)
        message = session.open(packet, header, self.host_us(now_us))
        if known is None and not isinstance(message, Refusal):
            self._sessions[header.robot] = session
        return message

    def _open_assign(self, packet: bytes, header: Header, now_us: int) -> Message | Refusal:
        assign = opened_assign(packet, self._key, self._nonce, now_us)
        if not isinstance(assign, Refusal):
            self._take(assign, header, now_us)
        return assign

    def _take(self, assign: Assign, header: Header, now_us: int) -> None:
        """Take the host's time, and its session where that is a new one."""
        number = assign.host_nonce & 0xFFFFFFFF
        if number == self._number:
            self._clock.tighten(assign.robot_us, header.sent_us, now_us)
        else:
            self._number, self._sessions = number, {}
            self._clock = HostClock(assign.robot_us, header.sent_us, now_us)
        self._is_astray = False
        self._nonce = self._draw_nonce()

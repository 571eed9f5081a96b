"""What the host knows of one robot: its key, its session, where it is and how well it hears."""

from collections import Counter, deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from tagmetry.link.bodies import pack_body, unpack_body
from tagmetry.link.carrier import Address
from tagmetry.link.keys import session_key
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Assign, Hello, Message, Time, TimeReply
from tagmetry.link.packet import Header, Refusal, body_of, is_sealed_with, seal
from tagmetry.link.session import Session

STOPPED_FLAG = 1
_MOST_OFFERED = 4
_MOST_REMEMBERED = 1000
_GONE_US = 1_500_000


@dataclass(frozen=True)
class RobotLink:
    """How the link to one robot does.

    Attributes:
        robot_id: Which.
        is_linked: It was heard in the last one and a half seconds.
        address: Where it sends from; None before it was ever linked.
        silence_s: Since it was last heard; infinite before.
        round_trip_s: To the host and back, as the robot measured it last; None before.
        loss_from_robot: Fraction of its last thousand packets that did not arrive.
        loss_to_robot: Fraction of the host's packets of this session that it did not hear.
        is_stopped: Its emergency stop is latched.
        refused: How many packets in its name were refused, and why.
    """

    robot_id: int
    is_linked: bool
    address: Address | None
    silence_s: float
    round_trip_s: float | None
    loss_from_robot: float
    loss_to_robot: float
    is_stopped: bool
    refused: Mapping[Refusal, int]


class Peer:
    """The host's side of one robot's link; it knows no sockets and no clock.

    A HELLO opens nothing: the host offers a session, which begins with the first packet that is
    sealed with its key. So a HELLO that somebody recorded in the days of an earlier host, and sends
    again, harms nobody; one that has led to a session already is refused.
    """

    def __init__(self, robot_id: int, key: bytes, draw_nonce: Callable[[], int]) -> None:
        self.robot_id = robot_id
        self.address: Address | None = None
        self.sent_us = 0
        self._key, self._draw_nonce = key, draw_nonce
        self._session: Session | None = None
        self._offered: dict[int, tuple[int, Session]] = {}  # robot's nonce: host's nonce, session
        self._used: deque[int] = deque(maxlen=_MOST_REMEMBERED)  # robot's nonces of sessions
        self._heard_us: int | None = None
        self._told: Time | None = None
        self._refused: Counter[Refusal] = Counter()

    @property
    def has_session(self) -> bool:
        """Whether packets can be sealed for it."""
        return self._session is not None and not self._session.is_spent

    def seal(self, message: Message, now_us: int) -> bytes:
        """Return a packet of the session that there must be."""
        if self._session is None:
            raise RuntimeError(f"robot {self.robot_id} has no session")
        self.sent_us = now_us
        return self._session.seal(message, now_us)

    def hear(
        self, packet: bytes, header: Header, address: Address, now_us: int
    ) -> Message | Refusal:
        """Return what a packet in this robot's name says, or why it is refused."""
        heard = self._open(packet, header, now_us)
        if isinstance(heard, Refusal):
            self._refused[heard] += 1
        elif not isinstance(heard, Hello):
            self._remember(heard, header, address, now_us)
        return heard

    def assign(self, hello: Hello, now_us: int) -> bytes:
        """Return the ASSIGN that answers a HELLO; the same one gets the same session."""
        if hello.robot_nonce not in self._offered:
            self._offer(hello.robot_nonce)
        host_nonce, _ = self._offered[hello.robot_nonce]
        _, body = pack_body(Assign(hello.robot_nonce, host_nonce, hello.robot_us))
        return seal(self._key, Header(Kind.ASSIGN, self.robot_id, now_us, 0, 0), body)

    def answer(self, message: Message, now_us: int) -> bytes | None:
        """Return the packet that a message of the session asks for; None for most."""
        if not isinstance(message, Time):
            return None
        return self.seal(TimeReply(message.robot_us), now_us)

    def link(self, now_us: int) -> RobotLink:
        """Return how the link does."""
        told, session = self._told, self._session
        silence_us = now_us - self._heard_us if self._heard_us is not None else None
        return RobotLink(
            self.robot_id,
            silence_us is not None and silence_us < _GONE_US,
            self.address,
            silence_us / 1e6 if silence_us is not None else float("inf"),
            told.round_trip_us / 1e6 if told is not None and told.round_trip_us else None,
            session.heard.loss() if session is not None else 0.0,
            1.0 - min(told.received / told.highest, 1.0) if told and told.highest else 0.0,
            told is not None and bool(told.flags & STOPPED_FLAG),
            dict(self._refused),
        )

    def _open(self, packet: bytes, header: Header, now_us: int) -> Message | Refusal:
        if header.kind is Kind.HELLO:
            return self._open_hello(packet)
        for session in self._sessions():
            if session.number == header.session:
                return self._opened(session, packet, header, now_us)
        return Refusal.SESSION

    def _open_hello(self, packet: bytes) -> Message | Refusal:
        if not is_sealed_with(self._key, packet):
            return Refusal.TAG
        hello = unpack_body(Kind.HELLO, body_of(packet))
        if not isinstance(hello, Hello):
            return Refusal.CONTENT
        return Refusal.REPLAYED if hello.robot_nonce in self._used else hello

    def _sessions(self) -> list[Session]:
        current = [] if self._session is None else [self._session]
        return current + [session for _, session in self._offered.values()]

    def _opened(
        self, session: Session, packet: bytes, header: Header, now_us: int
    ) -> Message | Refusal:
        heard = session.open(packet, header, now_us)
        if session is not self._session and not isinstance(heard, Refusal):
            self._begin(session)
        return heard

    def _begin(self, session: Session) -> None:
        """Take the offered session that the robot has just used; the old one is over."""
        nonces = {offered: nonce for nonce, (_, offered) in self._offered.items()}
        self._used.append(nonces[session])
        self._session = session
        self._offered, self._told = {}, None

    def _offer(self, robot_nonce: int) -> None:
        host_nonce = self._draw_nonce()
        key = session_key(self._key, robot_nonce, host_nonce)
        session = Session(key, host_nonce & 0xFFFFFFFF, self.robot_id)
        self._offered[robot_nonce] = host_nonce, session
        while len(self._offered) > _MOST_OFFERED:
            del self._offered[next(iter(self._offered))]

    def _remember(self, message: Message, header: Header, address: Address, now_us: int) -> None:
        self._heard_us = now_us
        if self._session is not None and header.counter == self._session.heard.highest:
            self.address = address  # a robot may move to another network; an old packet does not
        if isinstance(message, Time):
            self._told = message

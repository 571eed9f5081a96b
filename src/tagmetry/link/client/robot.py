"""The robot's end of the link, without sockets and clock: the same steps as the C client.

It moves only while it hears the host, and never longer than it was told: silence, a late packet or
the emergency stop bring it to a stand by itself.
"""

from collections.abc import Callable

from tagmetry.link.bodies import pack_body
from tagmetry.link.client.clock import HostClock
from tagmetry.link.client.greeting import opened_assign
from tagmetry.link.emergency import RELEASE, STOP
from tagmetry.link.keys import session_key
from tagmetry.link.layout import Kind
from tagmetry.link.messages import (
    Assign,
    Command,
    EmergencyStop,
    Hello,
    Message,
    Neighbours,
    Pose,
    Time,
    TimeReply,
)
from tagmetry.link.packet import Header, Refusal, read_header, seal
from tagmetry.link.peer import STOPPED_FLAG
from tagmetry.link.session import Session
from tagmetry.link.wire import (
    HELLO_US,
    LATE_US,
    LONGEST_COMMAND_MS,
    RELINK_US,
    SILENCE_US,
    TIME_US,
)

_STILL = Command()
_NO_SIGNS_OF_LIFE = (Kind.TIME_REPLY, Kind.ESTOP)  # the host's link sends them without its program


class Robot:
    """One robot's link; all times are microseconds of the robot's own clock.

    Attributes:
        pose: Where the host saw it last; None before.
        neighbours: Whom it would see; None before.
    """

    def __init__(self, robot_id: int, key: bytes, draw_nonce: Callable[[], int]) -> None:
        self.pose: Pose | None = None
        self.neighbours: Neighbours | None = None
        self._robot_id, self._key, self._draw_nonce = robot_id, key, draw_nonce
        self._nonce = draw_nonce()
        self._session: Session | None = None
        self._clock = HostClock(0, 0, 0)
        self._asked_us: int | None = None
        self._heard_us = 0  # robot's clock: the last packet that was accepted
        self._spoken_us: int | None = None  # host's clock: when the program was last alive
        self._round_trip_us = 0
        self._command = _STILL
        self._newest_us: dict[Kind, int] = {}  # host's clock: when the newest of a kind was sent
        self._is_stopped, self._edition = False, 0

    @property
    def is_stopped(self) -> bool:
        """Whether the emergency stop is latched."""
        return self._is_stopped

    @property
    def round_trip_us(self) -> int:
        """To the host and back, measured last; 0 before."""
        return self._round_trip_us

    def is_linked(self) -> bool:
        """Say whether there is a session."""
        return self._session is not None

    def may_move(self, now_us: int) -> bool:
        """Say whether the host is alive, holds this robot not, and no emergency stop is latched."""
        if self._session is None or self._spoken_us is None or self._is_stopped:
            return False
        if self._command.valid_for_ms == 0 and self._command_age_us(now_us) <= SILENCE_US:
            return False
        return self.host_us(now_us) - self._spoken_us <= SILENCE_US

    def command(self, now_us: int) -> Command:
        """Return how to move now; to stand still where nothing else is granted."""
        lifetime_us = 1000 * min(self._command.valid_for_ms, LONGEST_COMMAND_MS)
        is_valid = self._command_age_us(now_us) < lifetime_us
        return self._command if is_valid and self.may_move(now_us) else _STILL

    def host_us(self, now_us: int) -> int:
        """Return the host's time, never earlier than it is; only while linked."""
        return self._clock.host_us(now_us)

    def due(self, now_us: int) -> bytes | None:
        """Return the packet that is due by itself: HELLO or TIME; None for most calls."""
        if self._session is not None and (
            now_us - self._heard_us > RELINK_US or self._session.is_spent
        ):
            self._session, self._spoken_us, self._asked_us = None, None, None
            self._nonce = self._draw_nonce()
        pause_us = HELLO_US if self._session is None else TIME_US
        if self._asked_us is not None and now_us - self._asked_us < pause_us:
            return None
        self._asked_us = now_us
        return self._hello(now_us) if self._session is None else self._time(now_us)

    def seal(self, message: Message, now_us: int) -> bytes | None:
        """Return the packet of a message; None while not linked.

        Raises:
            InputError: The message holds what cannot be sent.
        """
        if self._session is None or self._session.is_spent:
            return None
        return self._session.seal(message, self.host_us(now_us))

    def receive(self, packet: bytes, now_us: int) -> Message | Refusal:
        """Take a packet: what it says, or why it is refused."""
        header = read_header(packet, "host")
        if isinstance(header, Refusal):
            return header
        if header.robot != self._robot_id:
            return Refusal.SENDER
        if header.kind is Kind.ASSIGN:
            return self._receive_assign(packet, header, now_us)
        if self._session is None:
            return Refusal.SESSION
        message = self._session.open(packet, header, self.host_us(now_us))
        if not isinstance(message, Refusal):
            self._heard_us = now_us
            if header.kind not in _NO_SIGNS_OF_LIFE:
                self._spoken_us = max(self._spoken_us or 0, header.sent_us)
            self._obey(message, header, now_us)
        return message

    def _command_age_us(self, now_us: int) -> int:
        return self.host_us(now_us) - self._newest_us.get(Kind.COMMAND, 0)

    def _hello(self, now_us: int) -> bytes:
        _, body = pack_body(Hello(self._nonce, now_us))
        return seal(self._key, Header(Kind.HELLO, self._robot_id, 0, 0, 0), body)

    def _time(self, now_us: int) -> bytes | None:
        if self._session is None:
            return None
        heard = self._session.heard
        flags = STOPPED_FLAG if self._is_stopped else 0
        told = Time(now_us, self._round_trip_us, heard.highest, heard.count, flags)
        return self.seal(told, now_us)

    def _receive_assign(self, packet: bytes, header: Header, now_us: int) -> Message | Refusal:
        if self._session is not None:
            return Refusal.SESSION
        assign = opened_assign(packet, self._key, self._nonce, now_us)
        if not isinstance(assign, Refusal):
            self._begin(assign, header, now_us)
        return assign

    def _begin(self, assign: Assign, header: Header, now_us: int) -> None:
        key = session_key(self._key, self._nonce, assign.host_nonce)
        self._session = Session(key, assign.host_nonce & 0xFFFFFFFF, self._robot_id)
        self._clock = HostClock(assign.robot_us, header.sent_us, now_us)
        self._round_trip_us = now_us - assign.robot_us
        self._heard_us, self._spoken_us, self._asked_us = now_us, None, None
        self._command, self.pose, self.neighbours = _STILL, None, None
        self._newest_us, self._edition = {}, 0

    def _obey(self, message: Message, header: Header, now_us: int) -> None:
        """Take what an accepted packet says; an older one never replaces a newer one."""
        if isinstance(message, EmergencyStop):
            self._take_stop(message)
        elif isinstance(message, TimeReply):
            self._take_time(message, header, now_us)
        elif header.sent_us >= self._newest_us.get(header.kind, 0):
            self._newest_us[header.kind] = header.sent_us
            self._take_newest(message)

    def _take_newest(self, message: Message) -> None:
        if isinstance(message, Command):
            self._command = message
        elif isinstance(message, Pose):
            self.pose = message
        elif isinstance(message, Neighbours):
            self.neighbours = message

    def _take_stop(self, message: EmergencyStop) -> None:
        if message.edition < self._edition:
            return
        self._edition = message.edition
        self._is_stopped = message.order == STOP or (self._is_stopped and message.order != RELEASE)

    def _take_time(self, message: TimeReply, header: Header, now_us: int) -> None:
        if 0 <= now_us - message.robot_us <= LATE_US:
            self._round_trip_us = now_us - message.robot_us
            self._clock.tighten(message.robot_us, header.sent_us, now_us)

"""One conversation of a robot and its host, from ASSIGN until either is silent for too long."""

from tagmetry.link.bodies import pack_body, unpack_body
from tagmetry.link.messages import Message
from tagmetry.link.packet import Header, Refusal, body_of, is_sealed_with, seal
from tagmetry.link.window import ReplayWindow
from tagmetry.link.wire import LATE_US

_LAST_COUNTER = 2**32 - 1


class Session:
    """Seals what one side sends, and opens what it hears: each packet once, and none that is late.

    Both sides have one with the same key. Times are microseconds of the host's clock, as well as
    the side knows it.
    """

    def __init__(self, key: bytes, number: int, robot_id: int) -> None:
        """Begin.

        Args:
            key: Of this session, 32 bytes.
            number: Which session; says nothing about the key.
            robot_id: Whose.
        """
        self._key, self._robot_id = key, robot_id
        self.number = number
        self.heard = ReplayWindow()
        self._counter = 0

    @property
    def is_spent(self) -> bool:
        """Whether all counters were used; the other side falls silent and a new one begins."""
        return self._counter >= _LAST_COUNTER

    def seal(self, message: Message, now_us: int) -> bytes:
        """Return the next packet.

        Raises:
            InputError: The message holds what cannot be sent.
        """
        kind, body = pack_body(message)
        self._counter += 1
        header = Header(kind, self._robot_id, now_us, self._counter, self.number)
        return seal(self._key, header, body)

    def open(self, packet: bytes, header: Header, now_us: int) -> Message | Refusal:
        """Return what a packet says, or why it is refused; a refused one changes nothing."""
        if header.session != self.number:
            return Refusal.SESSION
        if not self.heard.is_new(header.counter):
            return Refusal.REPLAYED
        if not is_sealed_with(self._key, packet):
            return Refusal.TAG
        if abs(now_us - header.sent_us) > LATE_US:
            return Refusal.LATE
        message = unpack_body(header.kind, body_of(packet))
        if message is None:
            return Refusal.CONTENT
        self.heard.add(header.counter)
        return message

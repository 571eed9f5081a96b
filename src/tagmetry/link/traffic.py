"""What went over the link, for those who take or record it."""

from dataclasses import dataclass

from tagmetry.link.bodies import unpack_body
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Message
from tagmetry.link.packet import body_of


@dataclass(frozen=True)
class Received:
    """A message of a robot.

    Attributes:
        robot_id: Whose.
        message: What it says.
        sent_us: When the robot sent it, in the host's clock as well as the robot knows it.
        received_us: When it arrived, in the host's clock.
    """

    robot_id: int
    message: Message
    sent_us: int
    received_us: int


@dataclass(frozen=True)
class Packet:
    """One packet that was sent, or was accepted, for a record of what each robot was told.

    Attributes:
        time_s: When, in the host's clock.
        robot_id: To or from which robot.
        kind: What it is about.
        is_incoming: From the robot.
        content: The packet, with header and tag.
    """

    time_s: float
    robot_id: int
    kind: Kind
    is_incoming: bool
    content: bytes


def packet_message(packet: Packet) -> Message | None:
    """Return what a packet says; None where that makes no sense."""
    return unpack_body(packet.kind, body_of(packet.content))

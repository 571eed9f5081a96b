"""Which robot a packet is from, and what it says: the host's end without sockets and clock."""

from collections import Counter
from collections.abc import Mapping

from tagmetry.link.carrier import Address
from tagmetry.link.layout import Kind
from tagmetry.link.messages import Hello
from tagmetry.link.packet import Refusal, read_header
from tagmetry.link.peer import Peer
from tagmetry.link.traffic import Received


class Hearing:
    """Hears all robots.

    Attributes:
        peers: The robots that are known.
        refused: How many packets were refused before their robot was even known, and why.
    """

    def __init__(self, peers: Mapping[int, Peer]) -> None:
        self.peers = peers
        self.refused: Counter[Refusal] = Counter()

    def hear(self, packet: bytes, address: Address, now_us: int) -> tuple[Peer, Received] | None:
        """Return who said what; None where the packet is refused, for whatever reason."""
        header = read_header(packet, "robot")
        if isinstance(header, Refusal):
            self.refused[header] += 1
            return None
        peer = self.peers.get(header.robot)
        if peer is None:
            self.refused[Refusal.SENDER] += 1
            return None
        message = peer.hear(packet, header, address, now_us)
        if isinstance(message, Refusal):
            return None
        return peer, Received(header.robot, message, header.sent_us, now_us)

    def reply(self, received: Received) -> tuple[Kind, bytes] | None:
        """Return the packet that answers a message; None for most."""
        peer, message = self.peers[received.robot_id], received.message
        if isinstance(message, Hello):
            return Kind.ASSIGN, peer.assign(message, received.received_us)
        answer = peer.answer(message, received.received_us)
        return (Kind.TIME_REPLY, answer) if answer is not None else None

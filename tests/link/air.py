"""A host and a robot, each with a clock of its own; the air between them is in the test's hands."""

from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from typing import Any

from compiled import CompiledRobot

from tagmetry.link.client import Robot
from tagmetry.link.hearing import Hearing
from tagmetry.link.messages import Message
from tagmetry.link.packet import Refusal
from tagmetry.link.peer import Peer

KEY = bytes(range(32))
ID = 3
HERE = ("127.0.0.1", 5000)
ROBOTS: dict[str, Callable[[], Any]] = {
    "python": lambda: Robot(ID, KEY, count(1001).__next__),
    "c": lambda: CompiledRobot(ID, KEY, seed=7),
}


@dataclass
class Air:
    """Time passes only when the test says so.

    Attributes:
        robot: Either client.
        robot_ahead_us: The robot's clock minus the host's, at the start.
        drift: How much faster the robot's clock runs.
    """

    robot: Any
    robot_ahead_us: int = 500_000_000
    drift: float = 0.0
    host_us: int = 10_000_000
    hearing: Hearing = field(
        default_factory=lambda: Hearing({ID: Peer(ID, KEY, count(77).__next__)})
    )

    @property
    def peer(self) -> Peer:
        return self.hearing.peers[ID]

    @property
    def robot_us(self) -> int:
        return self.host_us + self.robot_ahead_us + int(self.drift * self.host_us)

    def wait(self, duration_us: int) -> None:
        self.host_us += duration_us

    def to_robot(self, packet: bytes | None) -> bool:
        """Say whether the robot accepts a packet."""
        assert packet is not None
        heard = self.robot.receive(packet, self.robot_us)
        return heard is not None and not isinstance(heard, Refusal)

    def to_host(self, packet: bytes | None) -> list[bytes]:
        """Return the host's replies."""
        assert packet is not None
        heard = self.hearing.hear(packet, HERE, self.host_us)
        reply = None if heard is None else self.hearing.reply(heard[1])
        return [] if reply is None else [reply[1]]

    def is_heard(self, packet: bytes | None) -> bool:
        """Say whether the host accepts a packet."""
        assert packet is not None
        return self.hearing.hear(packet, HERE, self.host_us) is not None

    def send(self, message: Message) -> bytes:
        """Return the host's packet for the robot."""
        return self.peer.seal(message, self.host_us)

    def say(self, message: Message) -> bytes | None:
        """Return the robot's packet for the host."""
        packet: bytes | None = self.robot.seal(message, self.robot_us)
        return packet

    def link(self, delay_us: int = 500) -> "Air":
        """Let robot and host meet: HELLO, ASSIGN, TIME, TIME_REPLY, each on its way for a while."""
        return self.link_from(self.robot.due(self.robot_us), delay_us)

    def link_from(self, hello: bytes | None, delay_us: int = 500) -> "Air":
        """Let them meet, beginning with a HELLO that the robot has just given."""
        self._exchange(hello, delay_us)
        self._exchange(self.robot.due(self.robot_us), delay_us)
        return self

    def _exchange(self, packet: bytes | None, delay_us: int) -> None:
        self.wait(delay_us)
        replies = self.to_host(packet)
        self.wait(delay_us)
        assert [self.to_robot(reply) for reply in replies] == [True]

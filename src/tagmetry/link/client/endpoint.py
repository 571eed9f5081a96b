"""A robot's end of the link with a clock; those that have a way for its packets build on it."""

from abc import ABC, abstractmethod
from collections.abc import Callable

from tagmetry.link.client.robot import Robot
from tagmetry.link.messages import Command, Message, Neighbours, Pose
from tagmetry.link.packet import Refusal


class Endpoint(ABC):
    """What a robot's own loop asks and says.

    Call `step` at least every few hundredths of a second, and drive as `command` says after it.
    """

    def __init__(self, robot: Robot, clock: Callable[[], int]) -> None:
        """Take the robot's link, and its clock in microseconds."""
        self._robot, self._clock = robot, clock

    @property
    def is_linked(self) -> bool:
        """Whether there is a session."""
        return self._robot.is_linked()

    @property
    def is_stopped(self) -> bool:
        """Whether the emergency stop is latched."""
        return self._robot.is_stopped

    @property
    def may_move(self) -> bool:
        """Whether the host is alive, holds this robot not, and no emergency stop is latched."""
        return self._robot.may_move(self._clock())

    @property
    def command(self) -> Command:
        """How to move now; to stand still where nothing else is granted."""
        return self._robot.command(self._clock())

    @property
    def pose(self) -> Pose | None:
        """Where the host saw it last; None before."""
        return self._robot.pose

    @property
    def neighbours(self) -> Neighbours | None:
        """Whom it would see; None before."""
        return self._robot.neighbours

    @property
    def host_us(self) -> int:
        """The host's time now, for what is measured now; never earlier than it is."""
        return self._robot.host_us(self._clock())

    @property
    def round_trip_us(self) -> int:
        """To the host and back, measured last; 0 before."""
        return self._robot.round_trip_us

    def step(self, timeout_s: float = 0.02) -> list[Message]:
        """Send what is due, wait for packets, at most so long, and take all.

        Returns:
            What was accepted, oldest first.
        """
        self._write(self._robot.due(self._clock()))
        self._wait(timeout_s)
        taken: list[Message] = []
        while (packet := self._read()) is not None:
            message = self._robot.receive(packet, self._clock())
            if not isinstance(message, Refusal):
                taken.append(message)
        return taken

    def send(self, message: Message) -> bool:
        """Send to the host; False while not linked.

        Raises:
            InputError: The message holds what cannot be sent.
        """
        return self._write(self._robot.seal(message, self._clock()))

    @abstractmethod
    def _wait(self, timeout_s: float) -> None:
        """Wait until a packet is there, at most so long."""

    @abstractmethod
    def _read(self) -> bytes | None:
        """Return a packet, None where there is none."""

    @abstractmethod
    def _write(self, packet: bytes | None) -> bool:
        """Send a packet, where there is one; say whether it left."""

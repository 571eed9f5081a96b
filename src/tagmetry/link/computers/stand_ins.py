"""Each robot's stand-in on the arena's computer: what takes the commands of other computers.

It is the robot's end of the link itself (`tagmetry.link.client.Robot`), so that all of its contract
holds: keys, sessions, counters, ages, lifetimes, silence, and the latched emergency stop. Who
commands is the host of that link.
"""

from collections.abc import Callable, Collection

from tagmetry.link.client.robot import Robot
from tagmetry.link.computers.keys import command_key_of
from tagmetry.link.messages import Command
from tagmetry.link.packet import Refusal, read_header


class StandIns:
    """The stand-ins of all robots; they know neither net nor clock."""

    def __init__(
        self, robot_ids: Collection[int], key: bytes, draw_nonce: Callable[[], int]
    ) -> None:
        """Obey nobody yet.

        Args:
            robot_ids: The robots.
            key: Of those who command.
            draw_nonce: Draws random numbers of 64 bits.
        """
        self._robots = {
            robot_id: Robot(robot_id, command_key_of(robot_id, key), draw_nonce)
            for robot_id in robot_ids
        }

    @property
    def is_stopped(self) -> bool:
        """Whether a computer has pressed the emergency stop, and none has released it."""
        return any(robot.is_stopped for robot in self._robots.values())

    def hear(self, packet: bytes, now_us: int) -> bool:
        """Take a packet; say whether it was accepted."""
        header = read_header(packet, "host")
        robot = None if isinstance(header, Refusal) else self._robots.get(header.robot)
        return robot is not None and not isinstance(robot.receive(packet, now_us), Refusal)

    def due(self, now_us: int) -> list[tuple[int, bytes]]:
        """Return the packets that are due by themselves, with their robots' ids."""
        packets = ((key, robot.due(now_us)) for key, robot in self._robots.items())
        return [(key, packet) for key, packet in packets if packet is not None]

    def command(self, robot_id: int, now_us: int) -> Command | None:
        """Return how a robot shall move; None where no computer commands it.

        One that is silent for 250 ms lets it stand still; after a second it commands no more.
        """
        robot = self._robots[robot_id]
        return robot.command(now_us) if robot.is_linked() else None

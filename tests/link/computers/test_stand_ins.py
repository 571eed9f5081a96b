"""Robots obey another computer only with its key, in time, once, and while it lives."""

import random
from collections.abc import Sequence
from itertools import count

import pytest

from tagmetry.link import Command, EmergencyStop
from tagmetry.link.computers.keys import command_key_of
from tagmetry.link.computers.stand_ins import StandIns
from tagmetry.link.hearing import Hearing
from tagmetry.link.messages import Beat, Message
from tagmetry.link.peer import Peer

KEY = bytes(range(32))
IDS = (3, 4)
HERE = ("name", 0)


class Air:
    """Stand-ins and a commander, a host with another clock; the test carries the packets."""

    def __init__(self, key: bytes = KEY, robot_ids: Sequence[int] = IDS) -> None:
        self.now_us = 10_000_000
        self.stand_ins = StandIns(IDS, KEY, count(1001).__next__)
        self.commander = commander(key, robot_ids)

    @property
    def there_us(self) -> int:
        return self.now_us + 900_000_000

    def link(self) -> "Air":
        """Let HELLO, ASSIGN, TIME and TIME_REPLY pass for all robots."""
        for _ in range(2):
            self.pass_due(self.commander)
        return self

    def pass_due(self, commander: Hearing) -> None:
        for _, packet in self.stand_ins.due(self.now_us):
            heard = commander.hear(packet, HERE, self.there_us)
            reply = None if heard is None else commander.reply(heard[1])
            if reply is not None:
                self.stand_ins.hear(reply[1], self.now_us)

    def seal(self, message: Message, robot_id: int = 3) -> bytes:
        return self.commander.peers[robot_id].seal(message, self.there_us)

    def say(self, message: Message, robot_id: int = 3) -> bool:
        return self.stand_ins.hear(self.seal(message, robot_id), self.now_us)

    def forward_mps(self, robot_id: int = 3) -> float | None:
        command = self.stand_ins.command(robot_id, self.now_us)
        return None if command is None else command.forward_mps

    def wait(self, duration_us: int) -> None:
        self.now_us += duration_us


def commander(key: bytes, robot_ids: Sequence[int]) -> Hearing:
    draw = count(77).__next__
    return Hearing({one: Peer(one, command_key_of(one, key), draw) for one in robot_ids})


def test_a_command_is_obeyed_for_its_lifetime() -> None:
    air = Air().link()
    assert air.say(Command(0.5, valid_for_ms=100))
    assert air.forward_mps() == 0.5
    assert air.forward_mps(4) == 0.0
    air.wait(101_000)
    assert air.forward_mps() == 0.0


def test_nobody_commands_before_the_link_and_after_a_second_of_silence() -> None:
    air = Air()
    assert air.forward_mps() is None
    air.link()
    air.say(Command(0.5))
    air.wait(251_000)
    assert air.forward_mps() == 0.0
    air.wait(1_000_000)
    air.stand_ins.due(air.now_us)
    assert air.forward_mps() is None


def test_robots_that_nobody_asked_for_stay_as_they_are() -> None:
    air = Air(robot_ids=(3,)).link()
    assert air.forward_mps() == 0.0
    assert air.forward_mps(4) is None


def test_another_key_commands_nothing() -> None:
    air = Air(key=bytes(32)).link()
    assert air.forward_mps() is None
    assert not any(peer.has_session for peer in air.commander.peers.values())


def test_the_key_of_one_robot_is_not_that_of_another_nor_the_robots_own() -> None:
    assert len({command_key_of(n, KEY) for n in range(1000)} | {KEY}) == 1001


@pytest.mark.parametrize("delay_us", [251_000, 600_000])
def test_a_late_command_is_refused(delay_us: int) -> None:
    air = Air().link()
    packet = air.seal(Command(0.5))
    air.wait(delay_us)
    assert not air.stand_ins.hear(packet, air.now_us)
    assert air.forward_mps() == 0.0


def test_a_command_is_taken_once() -> None:
    air = Air().link()
    packet = air.seal(Command(0.5))
    assert air.stand_ins.hear(packet, air.now_us)
    assert not air.stand_ins.hear(packet, air.now_us)


def test_no_forged_command_is_taken() -> None:
    air, rng = Air().link(), random.Random(6)  # noqa: S311
    fresh = air.seal(Command(0.5))
    for _ in range(3000):
        packet = bytearray(fresh)
        packet[rng.randrange(len(packet))] ^= rng.randint(1, 255)
        assert not air.stand_ins.hear(bytes(packet), air.now_us)
        assert not air.stand_ins.hear(rng.randbytes(rng.randrange(80)), air.now_us)
    assert air.stand_ins.hear(fresh, air.now_us)


def test_a_second_commander_waits_until_the_first_is_silent() -> None:
    air = Air().link()
    second = commander(KEY, IDS)
    air.wait(500_000)
    air.say(Beat())
    air.pass_due(second)
    assert not second.peers[3].has_session
    air.wait(1_100_000)
    for _ in range(2):
        air.pass_due(second)
    assert second.peers[3].has_session


def test_an_emergency_stop_outlives_its_commander_until_it_is_released() -> None:
    air = Air().link()
    air.say(EmergencyStop(1, 1), 4)
    assert air.stand_ins.is_stopped
    air.wait(2_000_000)
    air.stand_ins.due(air.now_us)
    assert air.stand_ins.is_stopped
    air.commander = commander(KEY, IDS)
    air.wait(200_000)
    air.link()
    assert air.stand_ins.is_stopped
    air.say(EmergencyStop(1, 2), 4)
    assert not air.stand_ins.is_stopped

"""The host over real sockets of this computer: who is heard, who is not, what it tells."""

import socket
import time
from collections.abc import Callable

import pytest

from tagmetry.errors import InputError
from tagmetry.link import (
    Command,
    Host,
    Kind,
    Neighbour,
    Neighbours,
    Odometry,
    Packet,
    Refusal,
    RobotClient,
    Telemetry,
    now_us,
)
from tagmetry.link.packet import read_header

KEY, OTHER_KEY = bytes(range(32)), bytes(range(1, 33))


def step_until(robot: RobotClient, is_done: Callable[[], object], limit_s: float = 5.0) -> None:
    """Let the robot live until something holds."""
    end_s = time.monotonic() + limit_s
    while not is_done():
        assert time.monotonic() < end_s, "it never came to that"
        robot.step(0.005)


def test_robot_and_host_talk() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: host.links()[0].is_linked)
        seen = Neighbours(now_us(), 0.5, (Neighbour(4, 0.3, 1.0, -1.0),))
        assert host.send(3, Command(0.5, valid_for_ms=250))
        assert host.send(3, seen)
        step_until(robot, lambda: robot.neighbours)
        assert robot.command == Command(0.5, valid_for_ms=250)
        assert robot.send(Odometry(robot.host_us, 1.0, 2.0, 3.0))
        assert robot.send(Telemetry(robot.host_us, (("volt", 7.5),)))
        taken: list[object] = []
        step_until(robot, lambda: taken.extend(host.take()) or len(taken) == 2)
    assert [type(one.message) for one in taken] == [Odometry, Telemetry]
    assert all(0 <= one.received_us - one.sent_us + 10_000 < 100_000 for one in taken)


def test_a_robot_moves_only_while_the_program_is_alive() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: host.pulse() or robot.may_move)
        step_until(robot, lambda: not robot.may_move)  # nobody pulses any more
        for _ in range(100):
            robot.step(0.01)
            assert not robot.may_move
        step_until(robot, lambda: host.pulse() or robot.may_move)


def test_the_emergency_stop_holds_until_it_is_released() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: host.pulse() or robot.may_move)
        host.stop()
        step_until(robot, lambda: robot.is_stopped)
        assert not host.send(3, Command(1.0))
        assert not robot.may_move
        with RobotClient(3, KEY, port=host.address[1]) as newcomer:
            step_until(newcomer, lambda: newcomer.is_stopped)
            host.release()
            step_until(newcomer, lambda: host.pulse() or newcomer.may_move)


def test_a_robot_that_a_former_host_stopped_waits_for_a_release() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: robot.is_linked)
        host.stop()
        step_until(robot, lambda: robot.is_stopped)
        port = host.address[1]
        host.close()
        with Host({3: KEY}, port=port) as heir:
            step_until(robot, lambda: heir.links()[0].is_stopped)
            assert robot.is_stopped
            heir.release()
            step_until(robot, lambda: not robot.is_stopped)


def test_without_the_key_nobody_is_linked() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, OTHER_KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: host.links()[0].refused.get(Refusal.TAG))
        assert not robot.is_linked
        assert not host.send(3, Command(1.0))
        assert host.links()[0].silence_s == float("inf")


def test_every_packet_is_told_as_it_went_over_the_wire() -> None:
    told: list[Packet] = []
    with (
        Host({3: KEY}, port=0, on_packet=told.append) as host,
        RobotClient(3, KEY, port=host.address[1]) as robot,
    ):
        step_until(robot, lambda: host.pulse() or robot.may_move)
        host.send(3, Command(1.0))
        robot.send(Odometry(robot.host_us, 1.0, 2.0, 3.0))
        step_until(robot, host.take)
    kinds = [packet.kind for packet in told]
    opening = [Kind.HELLO, Kind.ASSIGN, Kind.TIME, Kind.TIME_REPLY]
    assert sorted(opening, key=kinds.index) == opening
    assert {Kind.COMMAND, Kind.ODOMETRY} <= set(kinds)
    for packet in told:
        header = read_header(packet.content, "robot" if packet.is_incoming else "host")
        assert not isinstance(header, Refusal)
        assert (header.kind, header.robot) == (packet.kind, packet.robot_id)
    assert [packet.time_s for packet in told] == sorted(packet.time_s for packet in told)


def test_noise_stops_nobody() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: robot.is_linked)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as stranger:
            for size in [0, 1, 39, 40, 1200, 2048, 9000] * 30:
                stranger.sendto(b"\x4d" * size, host.address)
        robot.send(Odometry(robot.host_us, 1.0, 2.0, 3.0))
        step_until(robot, host.take)
        assert host.refused()[Refusal.FORM] > 100


def test_listens_to_this_computer_alone_unless_told_otherwise() -> None:
    with Host({}, port=0) as host:
        assert host.address[0] == "127.0.0.1"


def test_a_port_that_is_taken_is_refused() -> None:
    with Host({}, port=0) as host, pytest.raises(InputError, match=r"port \d+ .* is taken"):
        Host({}, port=host.address[1])


@pytest.mark.parametrize(
    ("keys", "reason"),
    [
        ({3: b"short"}, "expected 32 bytes as the key of robot 3, got 5"),
        ({70000: KEY}, "expected a robot's id, 0 to 65535, got 70000"),
        ({-1: KEY}, "expected a robot's id, 0 to 65535, got -1"),
        ({1: KEY, 2: KEY}, "a key of its own for every robot, found one twice"),
    ],
)
def test_ids_and_keys_that_cannot_be_used_are_refused(keys: dict[int, bytes], reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        Host(keys, port=0)


@pytest.mark.parametrize(
    ("address", "port", "reason"),
    [
        ("203.0.113.7", 0, "cannot listen at '203.0.113.7'"),
        ("no such name", 0, "cannot listen at 'no such name'"),
        ("127.0.0.1", 70000, "expected a port, 0 to 65535, got 70000"),
    ],
)
def test_addresses_that_are_not_here_are_refused(address: str, port: int, reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        Host({}, address, port)


def test_only_what_a_host_says_to_robots_it_knows_is_sent() -> None:
    with Host({3: KEY}, port=0) as host:
        assert not host.send(3, Command(1.0))  # not linked yet
        with pytest.raises(InputError, match=r"there is no robot 4: only \[3\]"):
            host.send(4, Command(1.0))
        with pytest.raises(InputError, match="Odometry is a message of robots"):
            host.send(3, Odometry(1, 0, 0, 0))


def test_a_client_needs_a_key_and_an_address() -> None:
    with pytest.raises(InputError, match="expected a key of 32 bytes, got 3"):
        RobotClient(3, b"key")
    with pytest.raises(InputError, match="no way to the host"):
        RobotClient(3, KEY, "no such name")
    with pytest.raises(InputError, match="no way to the host"):
        RobotClient(3, KEY, port=70000)


def test_a_client_without_a_host_stands_still_and_goes_on_asking() -> None:
    with RobotClient(3, KEY, port=9) as robot:
        for _ in range(5):
            assert robot.step(0.001) == []
        assert not robot.may_move
        assert not robot.send(Odometry(1, 0, 0, 0))


def test_a_program_that_never_rests_from_sending_hears_all_the_same() -> None:
    with Host({3: KEY}, port=0) as host, RobotClient(3, KEY, port=host.address[1]) as robot:
        step_until(robot, lambda: host.send(3, Command()))
        host._is_closing.set()
        host._thread.join()  # the link's own thread gets no turn any more
        host.take()
        for number in range(10):
            assert robot.send(Odometry(number, 0.0, 0.0, 0.0))
        for _ in range(8):
            host.send(3, Command())
        heard = [one.message.measured_us for one in host.take()]
    assert heard == list(range(10))

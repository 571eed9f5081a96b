"""A robot stands still within 300 ms after its host was killed, stopped or cut off."""

import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from air import ROBOTS, Air
from compiled import SOURCES, build

from tagmetry.link import Command, EmergencyStop
from tagmetry.link.messages import Beat

HOST = """
import sys, time
from tagmetry.link import Command, Host
with Host({3: bytes(range(32))}, port=0) as host:
    print(host.address[1], flush=True)
    while True:
        host.send(3, Command(0.5, valid_for_ms=int(sys.argv[1])))
        time.sleep(0.02)
"""
ROBOT_C = """
#include <stdio.h>
#include <stdlib.h>
#include "tagmetry_posix.h"
int main(int count, char **words) {
    uint8_t key[TM_KEY_BYTES];
    tm_robot robot;
    int was_moving = -1, host = tm_connect("127.0.0.1", (uint16_t)atoi(words[count - 1]));
    for (int i = 0; i < TM_KEY_BYTES; i++) key[i] = (uint8_t)i;
    tm_begin(&robot, 3, key);
    for (;;) {
        tm_step(&robot, host, 5);
        int is_moving = tm_command(&robot, tm_now_us()).forward_mps > 0;
        if (is_moving == was_moving) continue;
        printf("%d %llu\\n", was_moving = is_moving, (unsigned long long)tm_now_us());
        fflush(stdout);
    }
}
"""
ROBOT_PYTHON = """
import sys
from tagmetry.link import RobotClient, now_us
was_moving = None
with RobotClient(3, bytes(range(32)), port=int(sys.argv[1])) as robot:
    while True:
        robot.step(0.005)
        is_moving = robot.command.forward_mps > 0
        if is_moving != was_moving:
            was_moving = is_moving
            print(int(is_moving), now_us(), flush=True)
"""


def robot_command(client: str, folder: Path) -> list[str]:
    if client == "python":
        return [sys.executable, "-c", ROBOT_PYTHON]
    source = folder / "robot.c"
    source.write_text(ROBOT_C, "utf-8")
    sources = [SOURCES / "tagmetry_link.c", SOURCES / "tagmetry_posix.c", source]
    return [str(build(folder / "robot", *sources))]


def started(command: list[str]) -> subprocess.Popen[str]:
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True)


def wait_for(robot: subprocess.Popen[str], state: str) -> int:
    """Return when the robot said that it moves (1) or stands (0)."""
    assert robot.stdout is not None
    for line in robot.stdout:
        said, when_us = line.split()
        if said == state:
            return int(when_us)
    raise AssertionError("the robot's program ended")


def stop_time_s(client: str, end: signal.Signals, folder: Path, lifetime_ms: int) -> float:
    """Return how long a robot moved on after its host was ended."""
    host = started([sys.executable, "-c", HOST, str(lifetime_ms)])
    assert host.stdout is not None
    robot = started([*robot_command(client, folder), host.stdout.readline().strip()])
    try:
        wait_for(robot, "1")
        time.sleep(0.1)
        ended_us = time.monotonic_ns() // 1000
        host.send_signal(end)
        return (wait_for(robot, "0") - ended_us) / 1e6
    finally:
        for process in (host, robot):
            process.kill()
            process.wait()
            assert process.stdout is not None
            process.stdout.close()


@pytest.mark.skipif(sys.platform == "win32", reason="the C client's port is for POSIX")
@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGSTOP], ids=["killed", "frozen"])
@pytest.mark.parametrize("client", ROBOTS)
def test_stops_when_its_host_dies(client: str, end: signal.Signals, tmp_path: Path) -> None:
    assert 0 < stop_time_s(client, end, tmp_path, lifetime_ms=60_000) <= 0.3


@pytest.mark.parametrize("client", ROBOTS)
def test_stops_in_time_in_a_thousand_faults(client: str) -> None:
    """Delays, losses and repetitions at random; then the host dies, and held packets come later."""
    rng = random.Random(3)  # noqa: S311
    for _ in range(1000):
        air = Air(ROBOTS[client](), robot_ahead_us=rng.randint(10**9, 10**12))
        air.drift = rng.uniform(-1e-4, 1e-4)
        air.link(delay_us=rng.randint(100, 60_000))
        held: list[tuple[int, bytes]] = []
        for _ in range(rng.randint(1, 30)):
            air.wait(rng.randint(1000, 40_000))
            held += [(air.host_us + rng.randint(0, 400_000), packet) for packet in said(air, rng)]
            held = [item for item in held if not is_delivered(air, item)]
        died_us = air.host_us
        while air.host_us < died_us + 1_000_000:
            air.wait(rng.randint(1000, 10_000))
            held = [item for item in held if not is_delivered(air, item)]
            if air.host_us > died_us + 250_000:
                assert not air.robot.may_move(air.robot_us)
                assert air.robot.command(air.robot_us).forward_mps == 0


def said(air: Air, rng: random.Random) -> list[bytes]:
    """Return what the host says now: some of it is lost, some arrives twice."""
    packet = air.send(rng.choice([Beat(), Command(0.5, valid_for_ms=rng.randint(0, 60_000))]))
    return [packet] * rng.choice([0, 1, 1, 2])


def is_delivered(air: Air, item: tuple[int, bytes]) -> bool:
    arrives_us, packet = item
    if arrives_us > air.host_us:
        return False
    air.to_robot(packet)
    return True


@pytest.mark.parametrize("client", ROBOTS)
def test_an_emergency_stop_comes_in_time_in_a_thousand_faults(client: str) -> None:
    """Of its repetitions some are lost, late or doubled, and commands of before come after it."""
    rng = random.Random(4)  # noqa: S311
    for _ in range(1000):
        air = Air(ROBOTS[client](), robot_ahead_us=rng.randint(10**9, 10**12))
        air.link(delay_us=rng.randint(100, 60_000))
        before = [air.send(Command(0.5, valid_for_ms=60_000)) for _ in range(8)]
        air.to_robot(before[0])
        assert air.robot.command(air.robot_us).forward_mps == 0.5
        pressed_us, held = air.host_us, [(air.host_us + rng.randint(0, 400_000), p) for p in before]
        while air.host_us < pressed_us + 600_000:
            air.wait(25_000)
            said_again = [air.send(EmergencyStop(1, 1))] * rng.choice([0, 0, 1, 1, 2])
            held += [(air.host_us + rng.randint(0, 200_000), packet) for packet in said_again]
            was_stopped = is_stopped(air)
            held = [item for item in held if not is_delivered(air, item)]
            assert is_stopped(air) >= was_stopped
            is_moving = air.robot.command(air.robot_us).forward_mps > 0
            assert not (is_moving and (is_stopped(air) or air.host_us > pressed_us + 300_000))
        assert is_stopped(air)


def is_stopped(air: Air) -> bool:
    return bool(air.robot.is_stopped)

"""An arena and those that look on, each a process of its own, over loopback TCP."""

import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from tagmetry.arena import RobotState

VIEW_KEY, COMMAND_KEY = bytes([3] * 32), bytes(range(32))
PATIENCE_S = 20.0  # of a machine that is busy; what is asked for takes milliseconds
ROBOTS = {number: f"robot {number}" for number in range(24)}
ARENA = """
import sys, time
from peers import COMMAND_KEY, ROBOTS, VIEW_KEY, robot_state
from tagmetry.link import Command, Neighbours, now_us
from tagmetry.link.computers import ArenaBridge, state_message
from tagmetry.link.messages import ArenaState

def resident_kib():
    if sys.platform != "linux":
        return 0
    with open("/proc/self/statm", encoding="ascii") as file:
        return 4 * int(file.read().split()[1])

endpoint, images, rate_hz = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
keys = {"view_key": VIEW_KEY, "command_key": COMMAND_KEY}
with ArenaBridge("lab", ROBOTS, listen=endpoint, **keys) as bridge:
    print("open", flush=True)
    sys.stdin.readline()
    began_s = time.monotonic()
    for image in range(images):
        time.sleep(max(began_s + image / rate_hz - time.monotonic(), 0))
        moment_us, told_s = now_us(), time.monotonic()
        for number in ROBOTS:
            bridge.tell(number, Neighbours(moment_us, 0.5))
            bridge.tell(number, bridge.command(number) or Command(valid_for_ms=0))
            state = robot_state(number, image)
            bridge.tell(number, state_message(state, moment_us, must_stand=number == 2))
        bridge.tell_image(ArenaState(moment_us, image, 0, len(ROBOTS), len(ROBOTS)))
        took_ms = 1000 * (time.monotonic() - told_s)
        if image % 60 == 0:
            print(image, f"{took_ms:.3f}", resident_kib(), flush=True)
    time.sleep(0.5)
"""


def robot_state(number: int, image: int) -> RobotState:
    """Return where a robot is in an image: everybody knows that."""
    place = 0.25 * number, image / 1024, 0.5
    return RobotState(number, ROBOTS[number], *place, 0.0, 0.0, np.eye(5), 0.0, True, 0.0)


def free_endpoint() -> str:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{found.getsockname()[1]}"


@contextmanager
def program(text: str, *words: object) -> Iterator[subprocess.Popen[str]]:
    """Run a program until the end of the block; it can import this file."""
    start = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
    command = [sys.executable, "-c", start + text, *map(str, words)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            yield process
        finally:
            process.kill()


@contextmanager
def arena(
    endpoint: str, images: int = 10**6, rate_hz: float = 120.0, *, begin: bool = True
) -> Iterator[subprocess.Popen[str]]:
    """Run an arena that tells so many images, once it is open."""
    with program(ARENA, endpoint, images, rate_hz) as process:
        assert line_of(process) == "open"
        if begin:
            start(process)
        yield process


def start(process: subprocess.Popen[str]) -> None:
    assert process.stdin is not None
    process.stdin.write("\n")
    process.stdin.flush()


def line_of(process: subprocess.Popen[str]) -> str:
    assert process.stdout is not None
    return process.stdout.readline().strip()


def until(is_so: Callable[[], bool], patience_s: float = PATIENCE_S) -> float:
    """Wait until something is so; return how long that took."""
    began_s = time.monotonic()
    while not is_so():
        assert time.monotonic() < began_s + patience_s, "it never came to that"
        time.sleep(0.002)
    return time.monotonic() - began_s

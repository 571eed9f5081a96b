"""Robots whose computers are processes of their own, over UDP, in lock-step with the physics."""

import os
import signal
import sys
from dataclasses import replace
from pathlib import Path

import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from twin_arenas import HERE, VIEW, pair, ran, twin_robot

from tagmetry.arena.drive import Twist
from tagmetry.arena.place import Place
from tagmetry.errors import InputError
from tagmetry.pipeline.arena.controller_file import load_controllers
from tagmetry.pipeline.arena_twin import Radio, Scenario, TwinArena
from tagmetry.pipeline.arena_twin.motor_bus import MotorBus
from tagmetry.pipeline.arena_twin.summary import Summing

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="robots' processes are for POSIX")
FOLLOW = """
from tagmetry.arena.controllers import SpringFollower
from tagmetry.arena.drive import Twist

def controller(robot):
    print("hello from robot", robot)
    return SpringFollower(robot - 1) if robot else lambda view: Twist(0.1, 0.3)
"""


def both(scenario, duration_s):
    """Return all places of a run with computers in this process, and in their own."""
    moments = [ran(scenario, duration_s), ran(scenario, duration_s, processes=True)]
    return [[list(moment.places.values()) for moment in one] for one in moments]


def test_steered_by_the_host_the_path_is_the_same_to_the_last_bit():
    here, apart = both(pair(0.05, loss=0.1), 3.0)
    assert apart == here
    assert here[-1][0].x_m > 0.2


def steering_themselves(file: Path) -> Scenario:
    make = load_controllers(file)
    robots = tuple(
        twin_robot(
            n, Place(-0.2 * n, 0, 0), lambda n=n: make(n), on_board=True, controller_file=file
        )
        for n in (0, 1)
    )
    return Scenario(robots, VIEW, radio=Radio(0.01, 0.004, 0.05))


def test_steered_from_a_file_on_board_the_path_is_the_same_to_the_last_bit(tmp_path):
    file = tmp_path / "follow.py"
    file.write_text(FOLLOW, "utf-8")
    here, apart = both(steering_themselves(file), 3.0)
    assert apart == here
    assert here[-1][0].x_m > 0.15
    assert here[-1][1].distance_m(here[-1][0]) == pytest.approx(0.2, abs=0.02)


def test_a_process_that_is_killed_is_named_and_the_rest_goes_on():
    runners = tuple(
        twin_robot(n, Place(0, 0.4 * n, 0), lambda: lambda _view: Twist(0.2, 0.0)) for n in (0, 1)
    )
    arena, summing = TwinArena(Scenario(runners, VIEW), processes=True), Summing()
    list(arena.run(1.0))
    os.kill(arena.crew.process_ids[0], signal.SIGKILL)
    for moment in arena.run(2.0):
        summing.take(moment)
    arena.close()
    assert moment.faults == {0: "its process ended with code -9"}
    assert abs(moment.twists[0].speed_mps) < 0.01
    assert moment.twists[1].speed_mps == pytest.approx(0.2, abs=0.01)
    assert not moment.links[0].is_linked
    assert moment.links[1].is_linked
    assert "robot 0: its process ended with code -9" in summing.summary().stopped


def program(code: str) -> tuple[str, ...]:
    return (sys.executable, "-S", "-c", code)


@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("print('fast please', flush=True); input()", "said what is no answer: could not convert"),
        ("print('nan 1', flush=True); input()", "no answer: wheel speeds of nan and 1"),
        ("print('x' * 5000, flush=True); input()", "no answer: more than 1000 bytes without"),
        ("print('3', flush=True); input()", "no answer: not enough values"),
        ("raise SystemExit(3)", "its process ended with code 3"),
        ("input(); print('0 0', flush=True); import time; time.sleep(99)", "within 0.3 s"),
        ("input(); print('0 0 low on oil', flush=True); input(); print('0 0 low on oil')", "oil"),
    ],
)
def test_a_program_that_fails_is_named(code, told):
    bus = MotorBus(program(code), patience_s=0.3)
    for now_us in (0, 8000):
        bus.tick(now_us, (0, 0))
        assert bus.answer() == (0.0, 0.0)
    bus.close()
    assert told in bus.fault


def test_programs_that_are_not_there_are_refused():
    twin = twin_robot(0, HERE, on_board=True, program=("/no/such/robot",))
    with pytest.raises(InputError, match="cannot start the robot's program '/no/such/robot'"):
        TwinArena(Scenario((twin,), VIEW), processes=True)
    unfiled = replace(twin, program=(), controller=lambda: lambda _view: Twist(0, 0))
    with pytest.raises(InputError, match=r"robot 0 steers by itself.*needs its controller's file"):
        TwinArena(Scenario((unfiled,), VIEW), processes=True)


@pytest.mark.slow
def test_a_whole_drive_of_leader_and_follower_is_the_same_to_the_last_bit():
    here, apart = both(pair(0.1, loss=0.02), 15.0)
    assert apart == here

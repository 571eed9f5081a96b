"""A robot's program in C drives a robot of the twin, as its twin in Python does."""

import os
import shutil
import signal
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest

pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")

from twin_arenas import VIEW, ran, twin_robot

from tagmetry.arena.place import Place
from tagmetry.link.client.sources import client_sources
from tagmetry.pipeline.arena.controller_file import load_controllers
from tagmetry.pipeline.arena_twin import Radio, Scenario, TwinArena

pytestmark = pytest.mark.skipif(
    shutil.which("gcc") is None or sys.platform == "win32", reason="needs gcc and POSIX"
)
DOCS = Path(__file__).parents[2] / "docs"
SPREAD = DOCS / "examples" / "spread.py"
WARNINGS = ["-Wall", "-Wextra", "-Werror"]


@cache
def spread_in_c() -> str:
    """Compile the documented program against the sources that `arena client` writes."""
    folder = Path(mkdtemp(prefix="tagmetry-spread-"))
    for name, content in client_sources().items():
        (folder / name).write_bytes(content)
    sources = [DOCS / "clients" / "spread.c", *sorted(folder.glob("*.c"))]
    command = ["gcc", "-O2", *WARNINGS, f"-I{folder}", *sources, "-lm", "-o", folder / "spread"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert ran.returncode == 0, ran.stderr
    return str(folder / "spread")


def crowd(count: int, radio: Radio) -> Scenario:
    """Return robots in a crowd that spread by themselves."""
    make = load_controllers(SPREAD)
    robots = tuple(
        twin_robot(
            n,
            Place(0.5 + 0.21 * (n % 2), 0.2 + 0.22 * (n // 2), 1.3 * n),
            lambda n=n: make(n),
            on_board=True,
            controller_file=SPREAD,
        )
        for n in range(count)
    )
    return Scenario(robots, VIEW, radio=radio)


def in_c(scenario: Scenario, robots: tuple[int, ...]) -> Scenario:
    return replace(
        scenario,
        robots=tuple(
            replace(one, program=(spread_in_c(),) if one.robot.id in robots else ())
            for one in scenario.robots
        ),
    )


def apart_mm(one, other) -> float:
    """Return how far apart two runs' robots ever were."""
    return 1000 * max(
        place.distance_m(b.places[robot])
        for a, b in zip(one, other, strict=True)
        for robot, place in a.places.items()
    )


def test_robots_in_c_take_the_same_paths_as_robots_in_python():
    scenario = crowd(4, Radio(0.01, 0.0))
    python = ran(scenario, 2.5)
    c = ran(in_c(scenario, (0, 1, 2, 3)), 2.5, processes=True)
    driven_m = [python[-1].places[n].distance_m(python[0].places[n]) for n in range(4)]
    assert min(driven_m) > 0.05
    assert apart_mm(python, c) < 0.3
    for robot in range(4):
        assert c[-1].odometry[robot].x_m == pytest.approx(python[-1].odometry[robot].x_m, abs=1e-3)


@pytest.mark.slow
def test_c_among_python_in_processes_with_loss():
    scenario = crowd(4, Radio(0.01, 0.004, 0.05))
    python = ran(scenario, 15.0)
    mixed = ran(in_c(scenario, (0, 2)), 15.0, processes=True)
    off_mm = apart_mm(python, mixed)
    print(f"paths apart by {off_mm:.3f} mm at most")
    assert off_mm < 5.0


def test_a_robot_in_c_stops_by_itself_when_the_host_falls_silent():
    arena = TwinArena(in_c(crowd(2, Radio(0.01, 0.0)), (0, 1)), processes=True)
    list(arena.run(1.0))
    assert max(np.hypot(t.speed_mps, t.turn_rate_radps) for t in arena.physics.twists()) > 0.05
    arena._base.beat = arena._base.send = lambda *_: None
    list(arena.run(0.4))  # 250 ms of silence, and the wheels' braking
    assert max(abs(twist.speed_mps) for twist in arena.physics.twists()) < 0.02
    os.kill(arena.crew.process_ids[0], signal.SIGKILL)
    *_, last = arena.run(0.1)
    assert last.faults == {0: "its process ended with code -9"}
    arena.close()

"""What steers simulated robots from on board: a controller's file, or programs of their own."""

import shlex
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.pipeline.arena_twin import Scenario, TwinRobot


def manned(
    scenario: Scenario, controller: Path | None, programs: Sequence[str], *, processes: bool
) -> Scenario:
    """Return a scenario whose robots steer themselves as far as it is asked for.

    Args:
        scenario: With controllers that run on the host.
        controller: The file they come from, where they shall run on the robots.
        programs: A program of its own for some robots, each like `3=./robot`.
        processes: Each robot's computer is a process.
    """
    if programs and not processes:
        raise InputError("--program is a robot's process; give --processes as well")
    if controller is not None and controller.suffix != ".py":
        raise InputError(f"--on-board needs a controller's file, {controller} is a scenario")
    own = dict(map(_program, programs))
    unknown = own.keys() - scenario.by_id.keys()
    if unknown:
        raise InputError(
            f"--program: there is no robot {min(unknown)}, only 0 to {len(scenario.robots) - 1}"
        )
    robots = (_manned(one, controller, own.get(one.robot.id, ())) for one in scenario.robots)
    return replace(scenario, robots=tuple(robots))


def _manned(twin: TwinRobot, controller: Path | None, program: tuple[str, ...]) -> TwinRobot:
    if program:
        return replace(twin, on_board=True, program=program)
    if controller is not None:
        return replace(twin, on_board=True, controller_file=controller)
    return twin


def _program(asked: str) -> tuple[int, tuple[str, ...]]:
    robot, _, command = asked.partition("=")
    try:
        words = tuple(shlex.split(command))
    except ValueError:
        words = ()
    if not robot.isdecimal() or not words:
        raise InputError(f"--program: expected a robot's program like 3=./robot, got {asked!r}")
    return int(robot), words

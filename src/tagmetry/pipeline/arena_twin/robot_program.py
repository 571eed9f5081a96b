"""A robot's computer as a process of its own: the link over UDP, the wheels over the motor bus.

python -m tagmetry.pipeline.arena_twin.robot_program … ADDRESS PORT ROBOT KEY
"""

import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path

from tagmetry.arena.controllers import Controller
from tagmetry.arena.drive import Drive
from tagmetry.link import RobotClient, parse_key
from tagmetry.pipeline.arena.controller_file import load_controllers
from tagmetry.pipeline.arena_twin.on_board import OnBoard


def main(words: Sequence[str] | None = None) -> None:
    """Answer every tick of standard input, until it ends."""
    asked = _parser().parse_args(words)
    ticks, answers = sys.stdin, sys.stdout
    sys.stdout = sys.stderr  # what a user's controller prints is no answer
    now_us = 0
    with RobotClient(
        asked.robot, parse_key(asked.key), asked.address, asked.port, clock=lambda: now_us
    ) as link:
        computer = OnBoard(asked.robot, _drive(asked), asked.encoder_steps, link, _steering(asked))
        for tick in ticks:
            now_us, left, right = map(int, tick.split())
            wheels = computer.step((left, right), now_us)
            answers.write(_answer(wheels, computer.fault))
            answers.flush()
        computer.close()


def _answer(wheels: tuple[float, float], fault: str | None) -> str:
    said = "" if fault is None else " " + " ".join(fault.split())[:800]
    return f"{wheels[0]!r} {wheels[1]!r}{said}\n"


def _drive(asked: Namespace) -> Drive:
    return Drive(asked.wheel_radius_m, asked.track_m, asked.top_wheel_speed_radps)


def _steering(asked: Namespace) -> Controller | None:
    return load_controllers(asked.controller)(asked.robot) if asked.controller else None


def _parser() -> ArgumentParser:
    parser = ArgumentParser(description="The computer of one robot of the simulated arena.")
    for name in ("--wheel-radius-m", "--track-m", "--top-wheel-speed-radps"):
        parser.add_argument(name, type=float, required=True)
    parser.add_argument("--encoder-steps", type=int, required=True)
    parser.add_argument("--controller", type=Path)
    parser.add_argument("address")
    parser.add_argument("port", type=int)
    parser.add_argument("robot", type=int)
    parser.add_argument("key")
    return parser


if __name__ == "__main__":
    main()

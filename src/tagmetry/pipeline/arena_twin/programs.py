"""Which program is a robot's, where its computer is a process of its own."""

import sys

from tagmetry.errors import InputError
from tagmetry.pipeline.arena_twin.scenario import TwinRobot


def program_of(twin: TwinRobot) -> tuple[str, ...]:
    """Return the program and its first words; host's address, port, robot's id and key follow.

    Raises:
        InputError: The robot steers by itself, and its controller is in no file.
    """
    if twin.program:
        return twin.program
    drive = twin.design.drive
    numbers = {
        "--wheel-radius-m": drive.wheel_radius_m,
        "--track-m": drive.track_m,
        "--top-wheel-speed-radps": drive.top_wheel_speed_radps,
        "--encoder-steps": twin.design.encoder_steps,
    }
    words = [f"{name}={number!r}" for name, number in numbers.items()]
    if twin.on_board and twin.controller is not None:
        words.append(f"--controller={_file_of(twin)}")
    return (sys.executable, "-m", "tagmetry.pipeline.arena_twin.robot_program", *words)


def _file_of(twin: TwinRobot) -> str:
    if twin.controller_file is None:
        raise InputError(
            f"robot {twin.robot.id} steers by itself; a process of its own needs its controller's "
            "file: give controller_file, or let the host steer it"
        )
    return str(twin.controller_file.absolute())

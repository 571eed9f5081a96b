"""The wires between a robot's process and its simulated wheels: a line of text each way per tick.

Its standard input says `TIME_US LEFT RIGHT`: its clock and what the encoders have counted. Its
standard output answers `LEFT RIGHT`: how fast the wheels shall turn, rad/s; what follows on that
line is a fault in words. It ends when its input does. Simulated time waits for the answer.
"""

import subprocess
import sys
from collections.abc import Sequence
from math import isfinite
from typing import IO

from tagmetry.errors import InputError
from tagmetry.pipeline.arena_twin.lines import Lines
from tagmetry.pipeline.arena_twin.on_board import WheelSpeeds

STANDING: WheelSpeeds = (0.0, 0.0)
_START_S = 120.0  # many processes that start at once wait for each other
_PATIENCE_S = 5.0
_END_S = 2.0


class MotorBus:
    """A robot's process and its wheels.

    Attributes:
        fault: What is wrong with the robot, in words; None while it does well.
    """

    def __init__(self, command: Sequence[str], patience_s: float = _PATIENCE_S) -> None:
        """Start the process.

        Args:
            command: The program and its words.
            patience_s: How long an answer may take; the first has time for its start.

        Raises:
            InputError: There is no such program, or this system cannot wait for it.
        """
        self.fault: str | None = None
        self._patience_s, self._next_s = patience_s, _START_S
        self._process = _started(command)
        self._lines = Lines(_wire(self._process.stdout))
        self._is_over = False

    @property
    def process_id(self) -> int:
        """Of the robot's process."""
        return self._process.pid

    def tick(self, now_us: int, counts: Sequence[int]) -> None:
        """Tell the time, and what the encoders have counted."""
        if self._is_over:
            return
        try:
            _wire(self._process.stdin).write(f"{now_us} {counts[0]} {counts[1]}\n".encode())
        except BrokenPipeError:
            self._end(self._ended())

    def answer(self) -> WheelSpeeds:
        """Return how fast the wheels shall turn; they stand still from the process's end on."""
        if self._is_over:
            return STANDING
        try:
            line = self._lines.next(self._next_s)
            self._next_s = self._patience_s
            if line is not None:
                return self._wheels(line)
        except TimeoutError:
            self._end(f"its process did not answer within {self._next_s:g} s")
        except ValueError as error:
            self._end(f"its process said what is no answer: {error}")
        else:
            self._end(self._ended())
        return STANDING

    def hang_up(self) -> None:
        """Let the process see its input end: it ends by itself."""
        _wire(self._process.stdin).close()

    def close(self) -> None:
        """End the process, which has been given a moment to do so itself."""
        self.hang_up()
        try:
            self._process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self._kill()
        _wire(self._process.stdout).close()

    def _wheels(self, line: bytes) -> WheelSpeeds:
        """Return what an answer wants.

        Raises:
            ValueError: It is no answer.
        """
        left, right, *fault = line.decode("utf-8", "replace").split(" ", 2)
        speeds = float(left), float(right)
        if not all(map(isfinite, speeds)):
            raise ValueError(f"wheel speeds of {left} and {right}")
        self.fault = fault[0] if fault else None
        return speeds

    def _ended(self) -> str:
        try:
            return f"its process ended with code {self._process.wait(_END_S)}"
        except subprocess.TimeoutExpired:
            return "its process closed its output"

    def _end(self, fault: str) -> None:
        self.fault, self._is_over = fault, True
        self._kill()

    def _kill(self) -> None:
        self._process.kill()
        self._process.wait()


def _started(command: Sequence[str]) -> subprocess.Popen[bytes]:
    if sys.platform == "win32":
        raise InputError("robots run as processes of their own on Linux and macOS only")
    try:
        return subprocess.Popen(  # noqa: S603 - the user's own program
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            bufsize=0,
            start_new_session=True,  # Ctrl-C is for the arena, which ends its robots itself
        )
    except OSError as error:
        raise InputError(f"cannot start the robot's program {command[0]!r}: {error}") from error


def _wire(end: IO[bytes] | None) -> IO[bytes]:
    """Return an end that there is: both are pipes."""
    if end is None:
        raise RuntimeError("a robot's process has no pipe")
    return end

"""The server's program as the arena knows it: told the newest, heard, and ended."""

import socket
import subprocess
import sys
import threading
import time
from typing import BinaryIO, cast

from tagmetry.errors import InputError
from tagmetry.live.beside.outbox import Outbox
from tagmetry.live.beside.parcels import Parcel, parcels, write_parcel
from tagmetry.live.beside.words import (
    ASKED,
    LEFT,
    REFUSAL,
    VIEWERS,
    Begin,
    begin_parcel,
    news_parcel,
)
from tagmetry.live.messages import Told
from tagmetry.live.messages.wire import parse_asked
from tagmetry.live.running import Runner

_STARTS_S, _ENDS_S, _LOOK_S = 60.0, 10.0, 0.02


class ServerProcess:
    """A program that serves an arena; the arena's threads only leave messages here."""

    def __init__(self) -> None:
        """Start the program; it waits until it is told to begin."""
        self._outbox = Outbox()
        self._runner: Runner | None = None
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tagmetry.live.beside.program"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        self._telling = threading.Thread(target=self._tell, name="to the server", daemon=True)
        self._hearing = threading.Thread(target=self._hear, name="from the server", daemon=True)

    @property
    def id(self) -> int:
        """The program's number in this computer."""
        return self._process.pid

    def give(self, message: Told) -> None:
        """Tell all pages; from any thread, and returns at once."""
        recording = None if self._runner is None else self._runner.recording
        self._outbox.put(type(message).__name__, news_parcel(message, recording))

    def begin(self, begin: Begin, runner: Runner) -> None:
        """Let it serve an arena, and wait until it does.

        Raises:
            InputError: It ended at once; why stands on the standard error output.
        """
        write_parcel(self._stdin, begin_parcel(begin))
        self._runner = runner
        self._telling.start()
        self._hearing.start()
        end_s = time.monotonic() + _STARTS_S
        while not _is_open(begin.address, begin.port):
            if self._process.poll() is not None or time.monotonic() > end_s:
                raise InputError("the server did not start; is the port taken meanwhile?")
            time.sleep(_LOOK_S)

    def wait(self) -> None:
        """Wait until the program has ended."""
        self._process.wait()

    def close(self) -> None:
        """End the program, and wait for it."""
        self._outbox.close()
        if self._runner is None:
            self._process.kill()  # it never served anybody
        else:
            self._telling.join(_ENDS_S)
        self._end_program()
        if self._runner is not None:
            self._hearing.join()
        self._stdout.close()

    def _end_program(self) -> None:
        """Close the program's input, at which it ends; what hangs is killed."""
        try:
            self._stdin.close()
            self._process.wait(_ENDS_S)
        except (OSError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()

    @property
    def _stdin(self) -> BinaryIO:
        return cast("BinaryIO", self._process.stdin)

    @property
    def _stdout(self) -> BinaryIO:
        return cast("BinaryIO", self._process.stdout)

    def _tell(self) -> None:
        """Send what waits; a program that takes its time gets the newest."""
        try:
            while (parcel := self._outbox.take()) is not None:
                write_parcel(self._stdin, parcel)
        except OSError:
            return  # the program has ended; `wait` says so

    def _hear(self) -> None:
        """Do what pages ask; where the program ends, so do the messages of the page that drives."""
        runner = self._runner
        for parcel in parcels(self._stdout):
            if runner is not None:
                self._do(runner, parcel)

    def _do(self, runner: Runner, parcel: Parcel) -> None:
        values = parcel.values
        if parcel.kind == VIEWERS:
            runner.viewers = values["count"]
        elif parcel.kind == LEFT:
            runner.leave(values["page"])
        elif parcel.kind == ASKED:
            self._ask(runner, values["page"], parcel.load.decode())

    def _ask(self, runner: Runner, page: int, text: str) -> None:
        try:
            runner.ask(page, parse_asked(text, "operator"))  # the server has checked the role
        except InputError as error:
            self._outbox.put(
                f"{REFUSAL} {page}", Parcel(REFUSAL, {"page": page, "why": str(error)})
            )


def _is_open(address: str, port: int) -> bool:
    """Say whether somebody answers at a port."""
    try:
        socket.create_connection((address, port), 1.0).close()
    except OSError:
        return False
    return True

"""The server's program: told by the arena through its standard input, it answers on its output.

It ends when its input ends, so that it never outlives the arena.
"""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from typing import BinaryIO

import uvicorn

from tagmetry.live.beside.far_runner import FarRunner
from tagmetry.live.beside.parcels import Parcel, parcels
from tagmetry.live.beside.words import NEWS, REFUSAL, Begin, begin_of
from tagmetry.live.messages import Refused
from tagmetry.live.rooms.every import opened_rooms
from tagmetry.live.server.access import Access
from tagmetry.live.server.hub import Hub
from tagmetry.live.server.serving import listening, server


def main() -> None:
    """Serve until the arena's program ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches both; the arena ends this one
    answers, told = _answers(), parcels(sys.stdin.buffer)
    first = next(told, None)
    if first is not None:  # otherwise the arena could not begin
        _serve(begin_of(first), answers, told)


def _serve(begin: Begin, answers: BinaryIO, told: Iterator[Parcel]) -> None:
    access, hub = Access(begin.address, begin.port, begin.token), Hub()
    runner = FarRunner(begin, answers)
    with (
        listening(begin.address, begin.port) as opened,
        opened_rooms(hub.give, runner, begin.furniture) as rooms,
    ):
        own = server(access, hub, runner, rooms)
        hearing = threading.Thread(target=_hear, args=(told, hub, runner, own), daemon=True)
        hearing.start()
        own.run(sockets=[opened])


def _answers() -> BinaryIO:
    """Return this program's output; whatever else prints does it where errors go."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    return answers


def _hear(told: Iterator[Parcel], hub: Hub, runner: FarRunner, own: uvicorn.Server) -> None:
    for parcel in told:
        if parcel.kind == NEWS:
            runner.recording = parcel.values["recording"]
            frame = parcel.load.decode() if parcel.values["is_text"] else parcel.load
            hub.pass_on(parcel.values["name"], frame)
        elif parcel.kind == REFUSAL:
            hub.refuse(parcel.values["page"], Refused(parcel.values["why"]))
    own.should_exit = True


if __name__ == "__main__":
    main()
    os._exit(0)  # Ctrl-C ends the server first; its thread still reads, which nothing interrupts

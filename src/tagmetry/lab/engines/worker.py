"""What runs in a child process: one engine, which answers orders until nobody asks any more.

An order is a tuple of images to keep, or the number of the image to look at.
"""

import math
import os
import signal
import time
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path

from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.engines.engine import Engine, EngineKind, Found

READY = "ready"
_RESETS_THE_PEAK = "5"  # see clear_refs in proc(5)


@dataclass(frozen=True, eq=False)
class Answer:
    """What an engine found, and what it took.

    Attributes:
        found: The markers.
        wall_s: By the clock.
        cpu_s: Of the processor, all threads together.
        memory_mib: The most that it has held since it got its images, beyond those and what it held
            before; NaN where the system does not tell.
    """

    found: Found
    wall_s: float
    cpu_s: float
    memory_mib: float


def serve(
    connection: Connection, kind: EngineKind, family: str, threads: int, complaints: str
) -> None:
    """Make an engine and answer orders; what it writes goes to the file `complaints`."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent ends us
    with Path(complaints).open("wb", buffering=0) as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    engine = kind.make(family, threads)
    connection.send(READY)
    bare_mib = _memory_mib("VmRSS")
    images: tuple[GreyPixels, ...] = ()
    while (order := _next(connection)) is not None:
        if isinstance(order, int):
            own_mib = bare_mib + sum(image.nbytes for image in images) / 2**20
            connection.send(_looked(engine, images[order], own_mib))
        else:
            images = order
            _forget_the_peak()
            connection.send(READY)


def _next(connection: Connection) -> tuple[GreyPixels, ...] | int | None:
    """Return the next order, None when the parent is gone."""
    try:
        order: tuple[GreyPixels, ...] | int = connection.recv()
    except EOFError:
        return None
    return order


def _looked(engine: Engine, image: GreyPixels, bare_mib: float) -> Answer:
    cpu_s, wall_s = time.process_time(), time.perf_counter()
    found = engine.detect(image)
    wall_s, cpu_s = time.perf_counter() - wall_s, time.process_time() - cpu_s
    return Answer(found, wall_s, cpu_s, max(0.0, _memory_mib("VmHWM") - bare_mib))


def _forget_the_peak() -> None:
    """Let the peak of the memory begin at what is held now."""
    switch = Path("/proc/self/clear_refs")
    if switch.exists():
        switch.write_text(_RESETS_THE_PEAK, encoding="ascii")


def _memory_mib(what: str) -> float:
    """Return the memory that the process holds (VmRSS), or held at most (VmHWM)."""
    status = Path("/proc/self/status")
    lines = status.read_text(encoding="ascii").splitlines() if status.exists() else []
    return next((int(line.split()[1]) / 1024 for line in lines if line.startswith(what)), math.nan)

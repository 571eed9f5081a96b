"""Runs the command as its own process, as a shell does."""

import json
import os
import subprocess
import sys
from dataclasses import dataclass

_CODE = "from tagmetry.cli.main import main; main()"
_BETWEEN = """
import json, resource, subprocess, sys
ran = subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
print(json.dumps([ran.returncode, used.ru_utime + used.ru_stime, used.ru_maxrss]))
"""


@dataclass(frozen=True)
class Scene:
    """A picture with its camera file; the markers and where they are stand in `showcase`."""

    picture: str
    camera: str
    ids: tuple[int, ...] = (0, 1, 2, 3, 10, 13, 14)


@dataclass(frozen=True)
class Usage:
    """What a process used: memory at its most, KiB on Linux."""

    code: int
    cpu_s: float
    memory_kib: int


def arguments_of(*arguments: object) -> list[str]:
    return [sys.executable, "-W", "error", "-c", _CODE, *map(str, arguments)]


def tagmetry(*arguments: object, **environment: str) -> subprocess.CompletedProcess:
    """Run the command and return what it wrote, as bytes."""
    return subprocess.run(
        arguments_of(*arguments),
        check=False,
        capture_output=True,
        timeout=120,
        env={**os.environ, **environment},
    )


def usage_of(*arguments: object) -> Usage:
    """Run the command in silence; return its exit code and what it used.

    A small process stands between: Linux counts the memory of whoever starts a process as that
    process's own, and a process that runs tests has much of it.
    """
    ran = subprocess.run(
        [sys.executable, "-c", _BETWEEN, *arguments_of(*arguments)],
        check=True,
        capture_output=True,
        timeout=120,
    )
    code, cpu_s, memory_kib = json.loads(ran.stdout)
    return Usage(code, cpu_s, memory_kib)

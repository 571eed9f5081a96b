"""Runs the command as its own process, as a shell does."""

import os
import resource
import subprocess
import sys
from dataclasses import dataclass

_CODE = "from tagmetry.cli.main import main; main()"


@dataclass(frozen=True)
class Scene:
    """A picture with its camera file; the markers and where they are stand in `showcase`."""

    picture: str
    camera: str
    ids: tuple[int, ...] = (0, 1, 2, 3, 10, 13, 14)


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


def usage_of(*arguments: object) -> tuple[int, resource.struct_rusage]:
    """Run the command in silence; return its exit code and what it used."""
    silent = [(os.POSIX_SPAWN_OPEN, fd, os.devnull, os.O_WRONLY, 0) for fd in (1, 2)]
    command = arguments_of(*arguments)
    process = os.posix_spawn(sys.executable, command, os.environ, file_actions=silent)
    _, status, usage = os.wait4(process, 0)
    return os.waitstatus_to_exitcode(status), usage

"""Runs the command as its own process, as a shell does."""

import os
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

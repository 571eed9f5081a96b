"""What the measurements were made on."""

import os
import platform
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from tagmetry import __version__

_PEERS = ("tagmetry", "numpy", "numba", "opencv-python-headless", "pyapriltags", "locus-tag")


@dataclass(frozen=True)
class Machine:
    """A computer and what is installed on it.

    Attributes:
        processor: Its name.
        cores: How many it offers.
        system: Operating system.
        python: Version.
        packages: Versions of the engines and what they stand on.
    """

    processor: str
    cores: int
    system: str
    python: str
    packages: dict[str, str]

    @property
    def hardware(self) -> str:
        """The processor and its cores, in words."""
        return f"{self.processor}, {self.cores} cores"


def this_machine() -> Machine:
    """Return what this process runs on."""
    return Machine(
        _processor(),
        os.cpu_count() or 1,
        f"{platform.system()} {platform.machine()}",
        platform.python_version(),
        {name: found for name in _PEERS if (found := _version(name)) is not None},
    )


def _processor() -> str:
    about = Path("/proc/cpuinfo")
    lines = about.read_text("utf-8").splitlines() if about.exists() else []
    names = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor() or platform.machine()


def _version(package: str) -> str | None:
    if package == "tagmetry":
        return __version__
    try:
        return version(package)
    except PackageNotFoundError:
        return None

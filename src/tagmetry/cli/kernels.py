"""The compiled loops: where their machine code is kept, and whether it is there.

Numba compiles a kernel when it is first called, and keeps the code beside the source or in the
user's cache; `NUMBA_CACHE_DIR` names another folder. It serves all later runs on this machine.
"""

import atexit
import os
import shutil
import sys
import tempfile
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

_SECONDS_EACH = 0.6  # to compile one, on a laptop
_NOT_KEPT = "tagmetry-not-kept-"
Kernel = Any  # Numba's have no types


def kernels(package: str = "tagmetry") -> dict[str, Kernel]:
    """Return the kernels of the imported modules of a package that are kept, by name."""
    from numba.core.dispatcher import Dispatcher

    found = {}
    for name, module in list(sys.modules.items()):
        if name == package or name.startswith(f"{package}."):
            for one in vars(module).values():
                if isinstance(one, Dispatcher) and one.stats.cache_path is not None:
                    function = one.py_func
                    found[f"{function.__module__}.{function.__qualname__}"] = one
    return found


def kept_count(some: dict[str, Kernel]) -> int:
    """Return how many kernels have code on disk that is newer than their source."""
    return sum(any(True for _ in _kept_files(kernel)) for kernel in some.values())


def compile_time_s(package: str) -> float:
    """Return about how long the first use of a package's imported kernels takes; 0 where kept.

    A package of which the greater part is kept is taken to be in use already.
    """
    some = kernels(package)
    missing = len(some) - kept_count(some)
    return _SECONDS_EACH * missing if missing > len(some) / 2 else 0.0


def cache_folder(some: dict[str, Kernel]) -> Path:
    """Return the folder below which kernels are kept."""
    return Path(os.path.commonpath([kernel.stats.cache_path for kernel in some.values()]))


def ensure_cache_folder() -> None:
    """Have Numba keep code for this process at least; it refuses to run without a folder.

    Must be called before any kernel is imported.
    """
    if "NUMBA_CACHE_DIR" in os.environ or any(_can_write(folder) for folder in _own_choices()):
        return
    folder = tempfile.mkdtemp(prefix=_NOT_KEPT)
    os.environ["NUMBA_CACHE_DIR"] = folder
    atexit.register(shutil.rmtree, folder, ignore_errors=True)


def is_kept() -> bool:
    """Say whether compiled code is there for later runs too."""
    return not Path(os.environ.get("NUMBA_CACHE_DIR", "")).name.startswith(_NOT_KEPT)


def _kept_files(kernel: Kernel) -> Iterator[Path]:
    function = kernel.py_func
    source = Path(function.__code__.co_filename)
    pattern = f"{source.stem}.{function.__qualname__}-*.nbi"
    for path in Path(kernel.stats.cache_path).glob(pattern):
        if path.stat().st_mtime >= source.stat().st_mtime:
            yield path


def _own_choices() -> list[Path]:
    """Return where Numba keeps code unless told: beside the source, or in the user's cache."""
    home = Path.home()
    cache = Path(os.environ.get("XDG_CACHE_HOME", home / ".cache"))
    if sys.platform == "darwin":
        cache = home / "Library" / "Caches"
    elif sys.platform == "win32":
        cache = Path(os.environ.get("LOCALAPPDATA", home))
    package = find_spec("tagmetry")
    beside = [Path(place) for place in package.submodule_search_locations or ()] if package else []
    return [*beside, cache]


def _can_write(folder: Path) -> bool:
    """Say whether a folder, or the nearest one above it that exists, can be written."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    return os.access(folder, os.W_OK | os.X_OK)

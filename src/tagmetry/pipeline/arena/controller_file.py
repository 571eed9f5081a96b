"""A user's controller from a Python file.

The file has a function `control(view)` that returns a Twist, or, for controllers that remember, a
function `controller(robot)` that is called once for every robot's id and returns such a function.
"""

import importlib.util
from collections.abc import Callable
from functools import partial
from pathlib import Path

from tagmetry.arena.controllers import Controller
from tagmetry.errors import InputError


def load_controllers(path: Path) -> Callable[[int], Controller]:
    """Return what makes a robot's controller from its id.

    Raises:
        InputError: The file is missing, raises when it is run, or has no such function.
    """
    spec = importlib.util.spec_from_file_location(f"controller_{path.stem}", path)
    if path.suffix != ".py" or spec is None or spec.loader is None or not path.is_file():
        raise InputError(f"{path}: expected a Python file with a function control(view)")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise InputError(f"{path}: raised {type(error).__name__}: {error}") from error
    if callable(made := getattr(module, "controller", None)):
        return partial(_made, path, made)
    if callable(control := getattr(module, "control", None)):
        return lambda _robot: control
    raise InputError(f"{path}: has neither a function control(view) nor controller(robot)")


def _made(path: Path, make: Callable[[int], object], robot: int) -> Controller:
    try:
        made = make(robot)
    except Exception as error:
        raise InputError(
            f"{path}: controller({robot}) raised {type(error).__name__}: {error}"
        ) from error
    if not callable(made):
        raise InputError(
            f"{path}: controller({robot}) returned {type(made).__name__}, a function is wanted"
        )
    return made

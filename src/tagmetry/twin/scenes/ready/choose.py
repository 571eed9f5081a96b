"""Ready-made scenes by their names, with parameters as files and people give them."""

from collections.abc import Callable, Mapping
from inspect import Parameter, getdoc, signature
from math import isfinite

from tagmetry.errors import InputError
from tagmetry.files.plain import shortened
from tagmetry.twin.recipe import Recipe
from tagmetry.twin.scenes.ready.arena import arena
from tagmetry.twin.scenes.ready.backlit import backlit_window
from tagmetry.twin.scenes.ready.corridor import corridor
from tagmetry.twin.scenes.ready.floor import floor
from tagmetry.twin.scenes.ready.room import room
from tagmetry.twin.scenes.ready.sweep import board_sweep
from tagmetry.twin.scenes.ready.wall import wall

READY: Mapping[str, Callable[..., Recipe]] = {
    "floor": floor,
    "wall": wall,
    "arena": arena,
    "corridor": corridor,
    "room": room,
    "board-sweep": board_sweep,
    "backlit-window": backlit_window,
}


def ready_recipe(name: str, parameters: Mapping[str, object] | None = None) -> Recipe:
    """Return the recipe of a ready-made scene.

    Args:
        name: One of `READY`.
        parameters: Of its function, by name; what is not given stays as it is.

    Raises:
        InputError: There is no such scene or parameter, or a value is of another kind.
    """
    if name not in READY:
        raise InputError(
            f"there is no ready-made scene {shortened(name)!r}; there are {', '.join(READY)}"
        )
    known = signature(READY[name]).parameters
    given = {key: _value(name, key, value, known) for key, value in (parameters or {}).items()}
    return READY[name](**given)


def sentence(name: str) -> str:
    """Return what a ready-made scene shows, in a line."""
    return (getdoc(READY[name]) or "").splitlines()[0]


def parameters_of(name: str) -> dict[str, object]:
    """Return the parameters of a ready-made scene with their defaults."""
    return {key: one.default for key, one in signature(READY[name]).parameters.items()}


def _value(name: str, key: str, value: object, known: Mapping[str, Parameter]) -> object:
    """Return a parameter's value as the kind that its default is of."""
    if key not in known:
        raise InputError(
            f"{name} has no parameter {shortened(key)!r}; there are {', '.join(known)}"
        )
    kind = type(known[key].default)
    if kind is float and type(value) is int:
        return float(value)
    if type(value) is not kind or (isinstance(value, float) and not isfinite(value)):
        expected = {int: "a whole number", float: "a number", str: "text", bool: "true or false"}
        raise InputError(f"{key}: expected {expected[kind]}, found {shortened(repr(value))}")
    return value

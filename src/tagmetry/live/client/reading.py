"""What the server sends, as the messages that it sent: the other way round of `live.wire`."""

from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, cast, get_args, get_origin, get_type_hints

from pydantic_core import from_json

from tagmetry.errors import InputError
from tagmetry.live.messages import CONTRACT, Told
from tagmetry.live.messages.wire import split_picture

_TOLD = {rule.name: rule.message for rule in CONTRACT if rule.sender == "server"}


def parse_told(frame: str | bytes) -> Told | None:
    """Return a message of the server; None for one of a kind that is not known here.

    Args:
        frame: As it came: text, or bytes with a picture behind it. Numbers that are null are NaN,
            and what a newer server adds is left out.

    Raises:
        InputError: It is no message, or not as the contract says.
    """
    text, jpeg = split_picture(frame) if isinstance(frame, bytes) else (frame, b"")
    try:
        values = from_json(text)
    except ValueError:
        raise InputError("expected a JSON object with a `type` from the server") from None
    if not isinstance(values, dict):
        raise InputError("expected a JSON object with a `type` from the server")
    kind = _TOLD.get(str(values.get("type")))
    if kind is None:
        return None
    return cast("Told", _value(kind, {**values, "jpeg": jpeg}, kind.__name__))


def _value(hint: Any, value: Any, where: str) -> Any:  # noqa: ANN401 - a hint may be anything
    """Return a JSON value as its type hint has it."""
    inner = get_args(hint)
    if get_origin(hint) is UnionType:
        own = next(one for one in inner if one is not NoneType)
        return None if value is None else _value(own, value, where)
    if get_origin(hint) is Literal:
        return _among(inner, value, where)
    if get_origin(hint) is tuple:
        return _items(inner, value, where)
    if is_dataclass(hint) and isinstance(hint, type):
        return _made(hint, value, where)
    return _plain(hint, value, where)


def _among(choices: tuple[Any, ...], value: object, where: str) -> object:
    if value not in choices:
        raise InputError(f"{where}: expected one of {choices}, got {value!r:.40}")
    return value


def _items(inner: tuple[Any, ...], value: object, where: str) -> tuple[Any, ...]:
    hints = inner
    if inner[-1] is Ellipsis and isinstance(value, list):
        hints = (inner[0],) * len(value)
    if not isinstance(value, list) or len(value) != len(hints):
        raise InputError(f"{where}: expected a list of {len(hints)}, got {value!r:.40}")
    return tuple(_value(hint, one, where) for hint, one in zip(hints, value, strict=True))


def _made(kind: type, value: object, where: str) -> object:
    hints = _hints(kind)
    if not isinstance(value, dict) or not hints.keys() <= value.keys():
        raise InputError(f"{where}: expected an object with {', '.join(hints)}, got {value!r:.40}")
    return kind(**{name: _value(hint, value[name], name) for name, hint in hints.items()})


def _plain(kind: type, value: object, where: str) -> object:
    if kind is float and (value is None or type(value) is int):
        return float("nan") if value is None else float(value)
    if type(value) is not kind:
        raise InputError(f"{where}: expected {kind.__name__}, got {value!r:.40}")
    return value


@cache
def _hints(kind: type) -> dict[str, Any]:
    known = get_type_hints(kind)
    return {field.name: known[field.name] for field in fields(kind)}

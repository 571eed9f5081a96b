"""Messages as text, and back: what does not follow the contract is refused in one line.

A picture is a binary message: the length of its JSON, 4 bytes with the lowest first, the JSON, and
the picture's file.
"""

from functools import cache
from typing import Any, cast

from pydantic import ConfigDict, TypeAdapter, ValidationError
from pydantic_core import from_json, to_json

from tagmetry.errors import InputError
from tagmetry.live.messages import CONTRACT, Asked, Picture, Role, Rule, Told
from tagmetry.live.rooms.calibrate.messages import CalibrationPicture
from tagmetry.live.rooms.lens.messages import LensPicture

MOST_BYTES = 1024  # of what a page says
_LENGTH_BYTES = 4
_STRICT = ConfigDict(extra="forbid", strict=True, allow_inf_nan=False, str_max_length=100)
_RULES = {rule.name: rule for rule in CONTRACT}


def packed(message: Told) -> str | bytes:
    """Return a message as it is sent: JSON, and a picture behind it where there is one."""
    if not isinstance(message, Picture | CalibrationPicture | LensPicture):
        return format_message(message)
    return joined_picture(format_message(message).encode(), message.jpeg)


def joined_picture(head: bytes, jpeg: bytes) -> bytes:
    """Return a binary message of a picture's JSON and its file."""
    return len(head).to_bytes(_LENGTH_BYTES, "little") + head + jpeg


def split_picture(content: bytes) -> tuple[str, bytes]:
    """Return a binary message's JSON and picture.

    Raises:
        InputError: It is too short.
    """
    end = _LENGTH_BYTES + int.from_bytes(content[:_LENGTH_BYTES], "little")
    if not _LENGTH_BYTES < end <= len(content):
        raise InputError("expected a picture's length, JSON and file, got something else")
    return content[_LENGTH_BYTES:end].decode("utf-8", "replace"), content[end:]


def format_message(message: Told | Asked) -> str:
    """Return a message as JSON, without its picture; numbers that are not finite become null."""
    named = {"type": type(message).__name__, **vars(message)}
    named.pop("jpeg", None)  # no text; it goes behind
    return to_json(named, inf_nan_mode="null").decode()


def parse_asked(text: str, role: Role) -> Asked:
    """Return what a page asks for.

    Args:
        text: As it came in.
        role: Of the page.

    Raises:
        InputError: It is too long, no message of a page, or more than the role may ask.
    """
    rule, values = _read(text)
    if rule.sender != "page":
        raise InputError(f"a page does not send {rule.name}")
    if rule.role == "operator" and role != "operator":
        raise InputError(f"{rule.name} needs the operator's role; sign in with the token")
    return _checked(rule, values)


def _checked(rule: Rule, values: dict[str, Any]) -> Asked:
    try:
        checked = _adapter(rule).validate_json(to_json(values))
    except ValidationError as error:
        first = error.errors(include_url=False, include_input=False)[0]
        where = ".".join(map(str, first["loc"]))
        raise InputError(f"{rule.name}: {where}: {first['msg']}") from None
    return cast("Asked", rule.message(**vars(checked)))


def _read(text: str) -> tuple[Rule, dict[str, Any]]:
    if len(text.encode()) > MOST_BYTES:
        raise InputError(f"a page's message has at most {MOST_BYTES} bytes, got {len(text)}")
    try:
        values = from_json(text, allow_inf_nan=False)
    except ValueError:
        raise InputError("expected a JSON object with a `type`") from None
    name = values.pop("type", None) if isinstance(values, dict) else None
    rule = _RULES.get(name) if isinstance(name, str) else None
    if rule is None:
        names = ", ".join(rule.name for rule in CONTRACT if rule.sender == "page")
        raise InputError(f"expected a message's `type`, one of {names}")
    return rule, values


@cache
def _adapter(rule: Rule) -> TypeAdapter[Any]:
    """Return what checks a message's fields, by a class of its own: messages stay plain."""
    return TypeAdapter(type(rule.name, (rule.message,), {"__pydantic_config__": _STRICT}))

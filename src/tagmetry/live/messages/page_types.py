"""The messages as the page's scripts know them: declarations that an editor or a checker reads.

Written into the page's folder by docs/make_pages.py; no browser loads them.
"""

import re
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from inspect import getdoc
from types import NoneType, UnionType
from typing import Any, Literal, get_args, get_origin, get_type_hints

from tagmetry.live.messages import CONTRACT, Asked, Told

_HEAD = """\
// What the server and the page say to each other, for editors and checkers of types.
// Written by docs/make_pages.py from tagmetry.live.messages. Numbers that are not finite are null.
"""
_SEND = """\
/** Sends what a page asks for: its type, and its other fields. */
export type Send = <T extends Asked["type"]>(
  type: T, fields?: Omit<Extract<Asked, { type: T }>, "type">) => boolean;
"""
_PLAIN = {float: "number", int: "number", str: "string", bool: "boolean", bytes: "Blob"}
_ATTRIBUTE = re.compile(r"^    (\w+): (.+(?:\n        .+)*)", re.MULTILINE)


def page_types() -> str:
    """Return the declarations of all messages and of what they consist of."""
    messages = [rule.message for rule in CONTRACT]
    parts = [part for message in messages for part in _parts(message)]
    interfaces = [_interface(one, is_message=one in messages) for one in dict.fromkeys(parts)]
    unions = [_union("Told", Told), _union("Asked", Asked)]
    return "\n".join([_HEAD, *interfaces, *unions, _SEND])


def _parts(kind: type) -> Iterator[type]:
    """Yield the dataclasses that a dataclass consists of, itself last."""
    for hint in get_type_hints(kind).values():
        for one in (hint, *get_args(hint)):
            if is_dataclass(one) and isinstance(one, type):
                yield from _parts(one)
    yield kind


def _interface(kind: type, *, is_message: bool) -> str:
    """Return one class's declaration."""
    hints, about = get_type_hints(kind), getdoc(kind) or ""
    told = {name: " ".join(text.split()) for name, text in _ATTRIBUTE.findall(about)}
    head = [f"/** {about.splitlines()[0]} */", f"export interface {kind.__name__} {{"]
    own = [f'  type: "{kind.__name__}";'] if is_message else []
    lines = [
        f"  /** {told[field.name]} */\n  {_named(field)}: {_spelled(hints[field.name])};"
        for field in fields(kind)
    ]
    return "\n".join([*head, *own, *lines, "}", ""])


def _named(field: Field[Any]) -> str:
    """Return a field's name, with a mark where it may be left out."""
    return field.name if field.default is MISSING else f"{field.name}?"


def _spelled(hint: Any) -> str:  # noqa: ANN401 - a type hint may be anything
    """Return a type as TypeScript has it."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin is Literal:
        return " | ".join(f'"{one}"' for one in inner)
    if origin is UnionType:
        return " | ".join("null" if one is NoneType else _spelled(one) for one in inner)
    if origin is tuple and inner[-1] is Ellipsis:
        item = _spelled(inner[0])
        return f"({item})[]" if "|" in item else f"{item}[]"
    if origin is tuple:
        return f"[{', '.join(map(_spelled, inner))}]"
    return _PLAIN.get(hint) or str(hint.__name__)


def _union(name: str, union: UnionType) -> str:
    names = [one.__name__ for one in get_args(union)]
    return f"export type {name} =\n  | " + "\n  | ".join(names) + ";\n"

"""JSON to values, for text that nobody vouches for."""

import json
import re

from tagmetry.errors import InputError
from tagmetry.files.plain import finite_number, shortened
from tagmetry.files.text import DEEPEST_NESTING

_STRINGS_AND_BRACKETS = re.compile(r'"(?:[^"\\]|\\.)*+"?|[\[{]|[\]}]', re.DOTALL)
_HALF_A_CHARACTER = re.compile("[\ud800-\udfff]")


def parse_json(text: str) -> object:
    """Return the value of a JSON document: dict, list, str, int, float, bool or None.

    Raises:
        InputError: It is not JSON, too deep, or has repeated keys or numbers that are not finite.
    """
    _check_depth(text)
    value = _loaded(text)
    if "\\u" in text and _HALF_A_CHARACTER.search(json.dumps(value, ensure_ascii=False)):
        raise InputError("a text has half a character, a \\ud… without its other half")
    return value


def _loaded(text: str) -> object:
    try:
        return json.loads(
            text,
            object_pairs_hook=_without_repeated_keys,
            parse_int=finite_number,
            parse_float=finite_number,
            parse_constant=_refuse_constant,
        )
    except json.JSONDecodeError as error:
        raise InputError(f"this is not JSON: line {error.lineno}: {error.msg}") from error


def _check_depth(text: str) -> None:
    """Count brackets outside strings, since the parser itself is recursive."""
    depth = 0
    for match in _STRINGS_AND_BRACKETS.finditer(text):
        first = match[0][0]
        depth += (first in "[{") - (first in "]}")
        if depth > DEEPEST_NESTING:
            raise InputError(f"nested deeper than {DEEPEST_NESTING} levels")


def _without_repeated_keys(pairs: list[tuple[str, object]]) -> dict[str, object]:
    table: dict[str, object] = {}
    for key, value in pairs:
        if key in table:
            raise InputError(f"the key {shortened(key)!r} stands there twice")
        table[key] = value
    return table


def _refuse_constant(word: str) -> float:
    raise InputError(f"expected a finite number, found {word}")

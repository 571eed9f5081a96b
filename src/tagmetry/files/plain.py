"""What an unquoted word in a file means: nothing, yes or no, a number, or itself.

These are the rules of YAML 1.2 and JSON, not those of YAML 1.1, which make 60-based numbers of
`1:30`, octal ones of `010`, text of `1e-5`, and a truth value of `no`. Digits that begin with a
needless zero are text: serial numbers and the bits of markers look like that.
"""

import re

from tagmetry.errors import InputError

_WORDS: dict[str, bool | None] = {
    "": None, "~": None, "null": None, "Null": None, "NULL": None,
    "true": True, "True": True, "TRUE": True,
    "false": False, "False": False, "FALSE": False,
}  # fmt: skip

_INTEGER = re.compile(r"[-+]?(?:0|[1-9][0-9]{0,17})")
_NUMBER = re.compile(r"[-+]?(?:(?:0|[1-9][0-9]*)(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")


def plain_value(word: str) -> bool | float | str | None:
    """Return what the word means."""
    if word in _WORDS:
        return _WORDS[word]
    return finite_number(word) if _NUMBER.fullmatch(word) else word


def finite_number(word: str) -> float:
    """Return an integer of up to 18 digits as it is, any other number as the nearest float."""
    if _INTEGER.fullmatch(word):
        return int(word)
    number = float(word)
    if number in (float("inf"), float("-inf")):
        raise InputError(f"the number {shortened(word)} is too large")
    return number


def shortened(text: str, longest: int = 40) -> str:
    """Return the text, or its beginning where it is long, to be shown in one line."""
    return text if len(text) <= longest else f"{text[:longest]}…"


def word_of(value: object) -> object:
    """Return an integer as text (serial numbers go unquoted), anything else as it is."""
    return str(value) if type(value) is int else value

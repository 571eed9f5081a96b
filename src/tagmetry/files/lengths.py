"""Lengths as people type them: metres, or a number with a unit (`120mm`, `12cm`, `4in`)."""

import re

from tagmetry.errors import InputError

_METRES = {"mm": 0.001, "cm": 0.01, "m": 1.0, "in": 0.0254, "": 1.0}
_LENGTH = re.compile(
    r"(?P<number>[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?)\s*(?P<unit>mm|cm|m|in)?",
    re.ASCII | re.IGNORECASE,
)
_ID = re.compile(r"\d{1,9}", re.ASCII)
_EXPECTED = "expected a length above 0 like 0.12 (metres), 120mm, 12cm or 4in"
_LONGEST_SHOWN = 40
_SHORTEST_M, _LONGEST_M = 1e-9, 1e9  # beyond, a unit or a finger slipped


def parse_length_m(text: str) -> float:
    """Return a length in metres.

    Args:
        text: A number in metres, or one followed by mm, cm, m or in.

    Raises:
        InputError: The text is no length, or one that is not positive, or beyond all sense.
    """
    match = _LENGTH.fullmatch(text.strip())
    if match is None:
        raise InputError(f"{_EXPECTED}, found {_shown(text)}")
    length_m = float(match["number"]) * _METRES[(match["unit"] or "").lower()]
    if not _SHORTEST_M <= length_m <= _LONGEST_M:
        raise InputError(f"{_EXPECTED}, found {_shown(text)}")
    return length_m


def parse_sizes_m(text: str) -> float | dict[int, float]:
    """Return one size for all markers, or the sizes by id, in metres.

    Args:
        text: A length, or `id=length` separated by commas: `7=0.05,8=12cm`.

    Raises:
        InputError: A length or an id cannot be read, or an id comes twice.
    """
    if "=" not in text:
        return parse_length_m(text)
    sizes_m: dict[int, float] = {}
    for entry in text.split(","):
        marker_id, size_m = _parse_entry(entry)
        if marker_id in sizes_m:
            raise InputError(f"id {marker_id} has two sizes in {_shown(text)}; give one")
        sizes_m[marker_id] = size_m
    return sizes_m


def _parse_entry(entry: str) -> tuple[int, float]:
    marker_id, equals, length = entry.partition("=")
    if not equals or not _ID.fullmatch(marker_id.strip()):
        raise InputError(f"expected sizes by id like 7=0.05,8=12cm, found {_shown(entry)}")
    return int(marker_id), parse_length_m(length)


def _shown(text: str) -> str:
    """Return the text quoted, shortened when long."""
    return repr(text if len(text) <= _LONGEST_SHOWN else text[:_LONGEST_SHOWN] + "…")


def format_mm(length_m: float) -> str:
    """Return a length as people read it, in millimetres: `101.6 mm`."""
    return f"{1000 * length_m:.7g} mm"

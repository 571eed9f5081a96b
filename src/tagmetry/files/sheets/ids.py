"""Lists of marker ids as people write them: `0-23,30`, or `all`."""

import re
from collections.abc import Sequence

from tagmetry.errors import InputError
from tagmetry.markers import MarkerFamily

_RANGE = re.compile(r"\s*(\d{1,9})\s*(?:-\s*(\d{1,9})\s*)?", re.ASCII)
_LONGEST_TEXT = 80


def parse_ids(text: str, family: MarkerFamily) -> tuple[int, ...]:
    """Return the ids that a text lists, in its order.

    Raises:
        InputError: The text is no list of ids, or the family lacks one of them.
    """
    if text.strip().lower() == "all":
        return tuple(range(len(family)))
    return tuple(i for part in text.split(",") for i in _parse_range(part, family))


def _parse_range(text: str, family: MarkerFamily) -> range:
    match = _RANGE.fullmatch(text)
    if match is None:
        raise InputError(f"expected ids like 0-23,30 or all, found {text[:40]!r}")
    first, last = int(match[1]), int(match[2] or match[1])
    if last < first:
        raise InputError(f"ids must rise within a range, found {text[:40]!r}")
    return range(first, family.checked_id(last) + 1)


def describe_ids(ids: Sequence[int]) -> str:
    """Return ids for a caption; a long list is only counted."""
    text = format_ids(ids)
    if len(text) > _LONGEST_TEXT:
        return f"{len(ids)} ids from {min(ids)} to {max(ids)}"
    return f"{'id' if len(ids) == 1 else 'ids'} {text}"


def format_ids(ids: Sequence[int]) -> str:
    """Return ids as a short text: runs are joined, 0-23, 30."""
    runs: list[list[int]] = []
    for marker_id in ids:
        if runs and marker_id == runs[-1][-1] + 1:
            runs[-1] = [runs[-1][0], marker_id]
        else:
            runs.append([marker_id])
    return ", ".join("-".join(map(str, run)) for run in runs)

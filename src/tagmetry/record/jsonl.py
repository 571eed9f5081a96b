"""JSON lines: one image, one line, in the file at once.

The file is written in place, so that others can read along; every line goes out in one piece, so
that a run that is killed leaves whole lines.
"""

import os
import sys
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import BinaryIO, Generic, Self, TypeVar

from pydantic import ValidationError

from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.files.atomic import refusing
from tagmetry.record.line import ImageLine, first_complaint
from tagmetry.record.result import ImageResult
from tagmetry.record.told import from_line, to_line

Item = TypeVar("Item")

LONGEST_LINE_BYTES = 64 * 2**20  # some 20,000 markers; a longer one is no line of ours


class CutLineWarning(UserWarning):
    """The last line of a file is half a line: the run that wrote it was killed."""


def format_line(result: ImageResult) -> str:
    """Return the JSON text of one image, without the line's end."""
    return to_line(result).model_dump_json(exclude_unset=True)


def parse_line(text: str | bytes) -> ImageResult:
    """Return the result that a JSON text tells of.

    Raises:
        InputError: It is no JSON, or a key is missing or wrong; the text names the key.
    """
    try:
        return from_line(ImageLine.model_validate_json(text))
    except ValidationError as error:
        raise InputError(first_complaint(error)) from None


def read_lines(path: Path) -> Iterator[ImageResult]:
    """Give the results of a file, one by one.

    Half a line at the end, as a killed run leaves it, is passed over with a `CutLineWarning`.

    Raises:
        InputError: A line is damaged; the text gives its number.
    """
    with path.open("rb") as file:
        for number, line in enumerate(iter(lambda: file.readline(LONGEST_LINE_BYTES), b""), 1):
            try:
                yield parse_line(line)
            except InputError as error:
                if len(line) == LONGEST_LINE_BYTES or line.endswith(b"\n"):
                    raise InputError(f"{path}, line {number}: {error}") from None
                text = f"{path}, line {number}: passed over, it was cut off while being written"
                warnings.warn(text, CutLineWarning, stacklevel=2)


class LinesWriter(Closing, Generic[Item]):
    """Writes results as JSON lines to a file or pipe, or to the standard output for `-`."""

    def __init__(self, path: str | Path, text_of: Callable[[Item], str]) -> None:
        """Choose the file, and what makes a line, without its end, of an item."""
        self._name = str(path)
        self._text_of = text_of
        self._file: BinaryIO = sys.stdout.buffer

    def __enter__(self) -> Self:
        if self._name != "-":
            with refusing(self._name):
                self._file = Path(self._name).open("wb", buffering=0)
        return self

    def write(self, item: Item) -> None:
        """Write one image; it is in the file when this returns."""
        content = self._text_of(item).encode() + b"\n"
        with refusing(self._name):
            _append_whole(self._file, content)

    def close(self) -> None:
        """Close the file; the standard output stays open."""
        if self._name != "-":
            self._file.close()


def _append_whole(file: BinaryIO, content: bytes) -> None:
    """Write and flush all of it, or, where a disk is full, nothing."""
    start = file.tell() if file.seekable() else None
    try:
        while content:
            content = content[file.write(content) :]
        file.flush()
    except OSError:
        if start is not None:
            with suppress(OSError):
                os.ftruncate(file.fileno(), start)
        raise

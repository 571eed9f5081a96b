"""The text of a file, with limits before anyone parses it."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from tagmetry.errors import InputError

LARGEST_BYTES = 4 * 1024 * 1024
DEEPEST_NESTING = 32


def read_text(path: Path, largest_bytes: int = LARGEST_BYTES) -> str:
    """Return the text of a small UTF-8 file, without its byte order mark.

    Raises:
        InputError: The file is missing, too large, empty, or not text.
    """
    content = _bytes_of(path, largest_bytes)
    if len(content) > largest_bytes:
        raise InputError(
            f"{path}: expected a text file of at most {largest_bytes >> 20} MiB, this one is larger"
        )
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected UTF-8 text, byte {error.start} is not") from error
    if "\0" in text:
        raise InputError(
            f"{path}: expected text, found a NUL byte at character {text.index(chr(0))}"
        )
    if not text.strip():
        raise InputError(f"{path}: the file is empty")
    return text


@contextmanager
def named_errors(name: str | Path) -> Iterator[None]:
    """Put the name of a file or of a part of it before every InputError of the block."""
    try:
        yield
    except InputError as error:
        raise InputError(f"{name}: {error}") from error


def _bytes_of(path: Path, largest_bytes: int) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(largest_bytes + 1)
    except FileNotFoundError as error:
        raise InputError(f"{path}: there is no such file") from error
    except IsADirectoryError as error:
        raise InputError(f"{path}: expected a file, this is a folder") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error

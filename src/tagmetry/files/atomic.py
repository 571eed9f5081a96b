"""Files appear whole or not at all.

What is written goes to a temporary file in the same folder, which takes the place of the old one
in a single step. Whatever interrupts the writing, an error, Ctrl-C or a full disk, the old file
stays as it was and nothing half-written is left.
"""

import errno
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO, Literal

from tagmetry.errors import InputError

_NO_FOLDER = "there is no folder {}; create it first"


def write_atomically(path: Path, content: bytes | str) -> None:
    """Write a whole file; text becomes UTF-8.

    Raises:
        InputError: The file cannot be written there.
    """
    encoded = content.encode() if isinstance(content, str) else content
    with refusing(path), replace_file(path) as file:
        file.write(encoded)


def check_destinations(*paths: Path | None) -> None:
    """Refuse before the work what could not be written after it.

    Raises:
        InputError: One of the files is a folder, or in a folder that is not there.
    """
    for path in filter(None, paths):
        if path.is_dir():
            raise InputError(f"cannot write {path}: Is a directory")
        parent = path.absolute().parent
        if not parent.is_dir():
            why = "Not a directory" if parent.exists() else _NO_FOLDER.format(path.parent)
            raise InputError(f"cannot write {path}: {why}")


@contextmanager
def replace_file(path: Path) -> Iterator[BinaryIO]:
    """Give a file to write to; it takes the place of `path` when the block ends without an error.

    A link is followed, an existing file's permissions are kept, and a device or pipe such as
    `/dev/stdout` is written directly.

    Raises:
        InputError: The file cannot be written there.
    """
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        with _opened(path, target, "wb") as device:
            yield device
        return
    temporary = target.with_name(f".tagmetry-{secrets.token_hex(8)}.tmp")
    file = _opened(path, temporary, "xb")
    try:
        with file:
            yield file
            file.flush()
            os.fsync(file.fileno())
        if target.exists():
            shutil.copymode(target, temporary)
        temporary.replace(target)
    finally:
        temporary.unlink(missing_ok=True)


def _opened(path: Path, opened: Path, mode: Literal["wb", "xb"]) -> BinaryIO:
    """Open a file; an error names the path that was asked for."""
    try:
        return opened.open(mode)
    except FileNotFoundError as error:
        if opened.parent.is_dir():  # as /proc says where nothing can be made
            raise _refusal(path, error) from error
        raise InputError(f"cannot write {path}: {_NO_FOLDER.format(opened.parent)}") from error
    except OSError as error:
        raise _refusal(path, error) from error


@contextmanager
def refusing(name: str | Path) -> Iterator[None]:
    """Turn what the system says of a file that cannot be written into one clear line.

    A reader that went away (a closed pipe) stays a `BrokenPipeError`: it is nobody's mistake.
    """
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        raise _refusal(name, error) from error


def _refusal(name: str | Path, error: OSError) -> InputError:
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    advice = "; make room or choose another place" if full else ""
    return InputError(f"cannot write {name}: {error.strerror or error}{advice}")

"""The files that a path, a folder or a pattern stands for, in the order people count in."""

import glob
import re
from collections.abc import Iterable
from pathlib import Path

from tagmetry.errors import InputError
from tagmetry.sources.content import PICTURE_SUFFIXES, VIDEO_SUFFIXES

_MAGIC = re.compile(r"[*?\[]")
_UNDERSTOOD = (
    "understood are pictures, folders and patterns of pictures, videos, a camera's number or "
    "device, and rtsp://, rtmp://, http:// and https:// streams"
)


def expand(spec: str | Path) -> list[Path]:
    """Return the files of a path, folder or pattern (`img*.png`, `run/**/*.jpg`), naturally sorted.

    Raises:
        InputError: There is no such file or folder, or nothing in it that is understood.
    """
    text, path = str(spec), Path(spec)
    if not text.strip():
        raise InputError(f"expected a source of images, got an empty name; {_UNDERSTOOD}")
    try:
        if path.is_dir():
            return _in_folder(path)
        if path.exists():
            return [path]
        if _MAGIC.search(text):
            return _matching(text)
    except OSError as error:
        raise InputError(f"{text!r} cannot be read: {error.strerror}") from error
    raise InputError(f"no such file, folder or camera: {text!r}; {_UNDERSTOOD}")


def natural_key(path: Path) -> list[tuple[int, int, str]]:
    """Return a key that sorts img2 before img10."""
    parts = re.split(r"([0-9]+)", str(path).lower())
    return [(1, int(part), part) if part[:1].isdecimal() else (0, 0, part) for part in parts]


def is_picture_name(path: Path) -> bool:
    """Say whether a file is named like a picture."""
    return path.suffix.lower() in PICTURE_SUFFIXES


def is_video_name(path: Path) -> bool:
    """Say whether a file is named like a video."""
    return path.suffix.lower() in VIDEO_SUFFIXES


def _in_folder(folder: Path) -> list[Path]:
    found = _sorted(p for p in folder.iterdir() if is_picture_name(p) and p.name[0] != ".")
    return found or _nothing(f"no pictures in the folder {str(folder)!r}", PICTURE_SUFFIXES)


def _matching(pattern: str) -> list[Path]:
    hits = [Path(hit) for hit in glob.glob(pattern, recursive=True)]  # noqa: PTH207 - absolute too
    found = _sorted(p for p in hits if is_picture_name(p) or is_video_name(p))
    understood = PICTURE_SUFFIXES + VIDEO_SUFFIXES
    return found or _nothing(f"no picture or video matches {pattern!r}", understood)


def _sorted(paths: Iterable[Path]) -> list[Path]:
    return sorted(paths, key=natural_key)


def _nothing(what: str, understood: tuple[str, ...]) -> list[Path]:
    raise InputError(f"{what}; understood are {' '.join(understood)}")

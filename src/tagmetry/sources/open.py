"""One call for every source of images: it looks at what is asked for and opens the right one."""

import re
from collections.abc import Sequence
from pathlib import Path

from tagmetry.camera import Camera, Source
from tagmetry.errors import InputError
from tagmetry.sources.cameras import camera_opener
from tagmetry.sources.connection import Opener
from tagmetry.sources.content import HEAD_BYTES, picture_kind
from tagmetry.sources.live import LiveSource
from tagmetry.sources.paths import expand, is_picture_name, is_video_name
from tagmetry.sources.pictures import Pictures
from tagmetry.sources.state import OnState
from tagmetry.sources.streams import SCHEMES, public_address, stream_opener
from tagmetry.sources.video import VideoFile

Spec = str | Path | int

_NUMBER = re.compile(r"[0-9]{1,9}")
_HIGHEST_CAMERA = 255


def open_source(
    spec: Spec | Sequence[str | Path],
    *,
    camera: Camera | None = None,
    grey: bool = False,
    loop: bool = False,
    on_state: OnState | None = None,
) -> Source:
    """Open a source of images.

    Args:
        spec: A picture, folder, pattern (`img*.png`) or several of them; a video file; a camera's
            number (`0`; a file of that name is `./0`) or device (`/dev/video0`); a stream
            (`rtsp://`, `rtmp://`, `http://`, `https://`).
        camera: Intrinsics that every image must fit; a camera of this computer is asked for their
            size.
        grey: Give grey images; for videos and streams the cheapest way, without conversion.
        loop: Begin again at the end; for pictures and video files.
        on_state: Told when a live source is lost and found again, from another thread.

    Raises:
        InputError: It is not there, or nothing that is understood.
        MissingExtraError: A video or stream is asked for and PyAV is not installed.
    """
    live = _live(spec, camera, grey=grey)
    if live is None:
        return _open_files(spec, camera, grey=grey, loop=loop)
    if loop:
        raise InputError(f"{live[0]} is live and cannot begin again: leave out the repetition")
    return LiveSource(*live, camera=camera, on_state=on_state)


def _live(
    spec: Spec | Sequence[str | Path], camera: Camera | None, *, grey: bool
) -> tuple[str, Opener] | None:
    """Return name and opener of a camera or stream, None for files."""
    if not isinstance(spec, (str, Path, int)):
        return None
    text, size_px = str(spec), camera.size_px if camera is not None else None
    if isinstance(spec, int) or _NUMBER.fullmatch(text):
        return f"camera {text}", camera_opener(_camera_number(text), size_px=size_px, grey=grey)
    if _is_device(text):
        return text, camera_opener(text, size_px=size_px, grey=grey)
    if "://" in text:
        return _stream(text, grey=grey)
    return None


def _camera_number(text: str) -> int:
    if not _NUMBER.fullmatch(text) or int(text) > _HIGHEST_CAMERA:
        raise InputError(f"expected a camera's number, 0 to {_HIGHEST_CAMERA}, got {text}")
    return int(text)


def _is_device(text: str) -> bool:
    return text.startswith("/dev/video") or (text.startswith("/dev/") and _is_character(Path(text)))


def _is_character(path: Path) -> bool:
    try:
        return path.is_char_device()
    except OSError:  # a name that no system allows; `expand` says so
        return False


def _stream(address: str, *, grey: bool) -> tuple[str, Opener]:
    scheme = address.partition("://")[0].lower()
    if scheme not in SCHEMES:
        understood = ", ".join(f"{name}://" for name in SCHEMES)
        raise InputError(f"streams of {scheme}:// are not understood; understood are {understood}")
    return public_address(address), stream_opener(address, grey=grey)


def _open_files(
    spec: Spec | Sequence[str | Path], camera: Camera | None, *, grey: bool, loop: bool
) -> Source:
    specs = [spec] if isinstance(spec, (str, Path, int)) else list(spec)
    paths = [path for each in specs for path in expand(str(each))]
    if len(paths) == 1 and not _is_picture(paths[0]):
        return VideoFile(paths[0], camera=camera, grey=grey, loop=loop)
    if any(is_video_name(path) for path in paths):
        raise InputError(f"{len(paths)} files, and videos among them: open one video at a time")
    name = str(specs[0]) if len(specs) == 1 else f"{len(paths)} pictures"
    return Pictures(paths, camera=camera, grey=grey, loop=loop, name=name)


def _is_picture(path: Path) -> bool:
    """Say by name or content; a file that is only named like a picture is refused as one later."""
    if is_picture_name(path) or not path.is_file():
        return is_picture_name(path)
    try:
        with path.open("rb") as file:
            return picture_kind(file.read(HEAD_BYTES)) is not None
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error

"""Opening files and streams with PyAV, and saying in words why one cannot be opened."""

from importlib.util import find_spec
from typing import TYPE_CHECKING, Literal

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.sources.headers import MAX_PIXELS

if TYPE_CHECKING:
    from av.container import InputContainer
    from av.video.stream import VideoStream

Threading = Literal["AUTO", "SLICE"]  # SLICE decodes without delay


def open_container(
    address: str,
    protocols: str,
    options: dict[str, str] | None = None,
    timeout_s: float | None = None,
) -> "InputContainer":
    """Open a file or stream that shows pictures.

    Args:
        address: With its scheme, so that nothing in a file's name is taken for one.
        protocols: Comma-separated list of what the content may refer to: a list of streams must not
            read this computer's files.
        options: Further options of FFmpeg.
        timeout_s: How long to wait for an answer, for opening and for each read.

    Raises:
        InputError: It cannot be opened or has no pictures.
        MissingExtraError: PyAV is not installed.
    """
    require_av()
    import av

    limits = {"protocol_whitelist": protocols, "max_pixels": str(MAX_PIXELS)}
    try:
        container = av.open(address, "r", options=limits | (options or {}), timeout=timeout_s)
    except (av.FFmpegError, OSError, ValueError) as error:
        raise InputError(f"cannot be opened: {reason(error)}") from error
    trouble = _trouble(container)
    if trouble:
        container.close()
        raise InputError(trouble)
    return container


def _trouble(container: "InputContainer") -> str:
    if not container.streams.video:
        return "has no pictures (no video stream)"
    codec: object = container.streams.video[0].codec_context  # PyAV's types forget the None
    if codec is None:
        return "its pictures are coded in a way that FFmpeg does not know, or the file is damaged"
    return ""


def require_av() -> None:
    """Raise MissingExtraError where PyAV is not installed."""
    if find_spec("av") is None:
        raise MissingExtraError("reading video", "video")


def video_stream(container: "InputContainer", threading: Threading) -> "VideoStream":
    """Return the first video stream, ready to be decoded by several threads."""
    stream = container.streams.video[0]
    stream.codec_context.thread_type = threading
    return stream


def reason(error: BaseException) -> str:
    """Return the cause of an error of FFmpeg without its number and address."""
    if type(error).__name__ == "ExitError":  # how PyAV ends what has taken too long
        return "no answer in time"
    return str(getattr(error, "strerror", None) or error)

"""The pictures of an open container, as far as they can be decoded."""

from collections.abc import Callable, Generator, Iterator
from typing import TYPE_CHECKING

from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.avlib import Threading, reason, video_stream
from tagmetry.sources.planes import pixels_of

if TYPE_CHECKING:
    from av import Packet
    from av.container import InputContainer
    from av.video.stream import VideoStream

TimedPixels = tuple[float | None, AnyPixels]
Warn = Callable[[str], None]


def decoded(
    container: "InputContainer", warn: Warn, *, grey: bool, threading: Threading = "AUTO"
) -> Generator[TimedPixels, None, None]:
    """Give (timestamp in seconds or None, pixels) of every picture that can be decoded.

    What cannot be decoded is left out and told to `warn`; a file is finite, so damage ends too.
    """
    stream = video_stream(container, threading)
    for packet in _packets(container, stream, warn):
        yield from _decoded_packet(stream, packet, warn, grey=grey)


def _packets(
    container: "InputContainer", stream: "VideoStream", warn: Warn
) -> Iterator["Packet[VideoStream] | None"]:
    """Give the packets, and None at the end of a damaged file: the decoder still holds pictures."""
    from av import FFmpegError

    try:
        yield from container.demux(stream)
    except (FFmpegError, OSError) as error:
        warn(f"the rest cannot be read: {reason(error)}")
        yield None


def _decoded_packet(
    stream: "VideoStream", packet: "Packet[VideoStream] | None", warn: Warn, *, grey: bool
) -> list[TimedPixels]:
    from av import FFmpegError

    try:
        return [(p.time, pixels_of(p, grey=grey)) for p in stream.decode(packet)]
    except (FFmpegError, ValueError, MemoryError) as error:
        warn(f"some images are damaged and left out: {reason(error)}")
        return []

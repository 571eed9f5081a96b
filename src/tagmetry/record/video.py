"""Overlays as a video: H.264 in MP4, every image at its own time."""

from contextlib import ExitStack
from fractions import Fraction
from typing import TYPE_CHECKING, BinaryIO, Literal

import numpy as np

from tagmetry.camera.image import Image
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.geometry.arrays import AnyPixels

if TYPE_CHECKING:
    from av import VideoStream

Codec = Literal["libx264", "mpeg4"]

TICKS_PER_S = 60_000  # MPEG-4 allows no more than 65,535
STEP_S = 1 / 30  # between images whose time is not known or does not advance
QUALITY: dict[Codec, dict[str, str]] = {
    "libx264": {"crf": "20", "preset": "veryfast"},
    "mpeg4": {"qscale": "3"},
}


class VideoEncoder:
    """Writes BGR images of one size to an MP4 file."""

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:
        """Open the container; the first image says how large the video is."""
        try:
            import av
        except ImportError as error:
            raise MissingExtraError("writing video", "video") from error

        self._container = stack.enter_context(av.open(file, "w", format="mp4"))
        self._stream: VideoStream | None = None
        self._clock = _Clock()

    def write(self, item: Image) -> None:
        """Add one image.

        Raises:
            InputError: It is of another size than the first.
        """
        from av import VideoFrame

        stream = self._stream or self._open_stream(item)
        if item.pixels.shape != self._shape:
            first = f"{self._shape[1]}x{self._shape[0]}"
            raise InputError(
                f"a video's images are of one size: the first is {first}, this one "
                f"{item.width_px}x{item.height_px}; write pictures instead (.png)"
            )
        frame = VideoFrame.from_ndarray(_even(item.pixels), format="bgr24")
        frame.pts, frame.time_base = self._clock.ticks(item), Fraction(1, TICKS_PER_S)
        self._container.mux(stream.encode(frame))

    def finish(self) -> None:
        """Write the images that the encoder still holds.

        Raises:
            InputError: There was no image.
        """
        if self._stream is None:
            raise InputError("there is no image to make a video of")
        self._container.mux(self._stream.encode(None))

    def _open_stream(self, image: Image) -> "VideoStream":
        from av import codecs_available

        codec: Codec = "libx264" if "libx264" in codecs_available else "mpeg4"
        stream = self._container.add_stream(codec, rate=round(1 / STEP_S), options=QUALITY[codec])
        height, width = _even(image.pixels).shape[:2]
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.time_base = stream.codec_context.time_base = Fraction(1, TICKS_PER_S)
        self._shape = image.pixels.shape
        self._stream = stream
        return stream


class _Clock:
    """Counts a video's time from its first image, always onward."""

    def __init__(self) -> None:
        self._first_s: float | None = None
        self._last = -1

    def ticks(self, image: Image) -> int:
        """Return the time of the next image."""
        if self._first_s is None:
            self._first_s = image.time_s
            self._last = 0
            return 0
        passed = (image.time_s - self._first_s) * TICKS_PER_S
        advances = np.isfinite(passed) and passed >= self._last + 1
        self._last = round(passed) if advances else self._last + round(STEP_S * TICKS_PER_S)
        return self._last


def _even(pixels: AnyPixels) -> AnyPixels:
    """Repeat the last row and column where there is an odd number: the codec halves the colour."""
    height, width = pixels.shape[:2]
    return np.pad(pixels, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")

"""A video file as a source of images, each with its own timestamp.

Rows are those that were recorded: a rotation written beside the video is ignored, as it is for
pictures, because intrinsics belong to the sensor.
"""

from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING

from tagmetry.camera import Camera, Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.avlib import open_container
from tagmetry.sources.content import HEAD_BYTES, describe, is_text
from tagmetry.sources.decoding import decoded
from tagmetry.sources.fit import checked_fit

if TYPE_CHECKING:
    from av.container import InputContainer

_RATE_WITHOUT_ONE_HZ = 25.0


class VideoFile(Closing):
    """Every image of a video file, in order.

    `Image.time_s` is the timestamp in the file, whatever the rate does. Where the file is damaged,
    the images that could be decoded are given and `warnings` says what is missing; only a file
    without a single image is refused.
    """

    def __init__(
        self,
        path: str | Path,
        *,
        camera: Camera | None = None,
        grey: bool = False,
        loop: bool = False,
    ) -> None:
        self.name = str(path)
        self._path, self._camera, self._grey, self._loop = Path(path), camera, grey, loop
        self._warnings: dict[str, None] = {}  # a set that keeps its order
        self._is_closed = False
        with closing(self._open()) as container:
            stream = container.streams.video[0]
            self._announced = max(stream.frames, 0)
            self._interval_s = 1.0 / float(stream.average_rate or _RATE_WITHOUT_ONE_HZ)

    @property
    def is_live(self) -> bool:
        """No: every image is given."""
        return False

    @property
    def length(self) -> int | None:
        """How many images the file announces; None where it does not, or is repeated."""
        return None if self._loop or not self._announced else self._announced

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was damaged or missing in the part that has been read."""
        return tuple(self._warnings)

    def __iter__(self) -> Iterator[Image]:
        """Give the images from the beginning; when repeated, time and sequence go on."""
        sequence, start_s = 0, 0.0
        while not self._is_closed:
            time_s = start_s
            for in_file_s, pixels in self._one_pass():
                time_s = start_s + in_file_s
                yield self._image(pixels, time_s, sequence)
                sequence += 1
            if not self._loop:
                return
            start_s = time_s + self._interval_s

    def close(self) -> None:
        """End every iteration before its next image."""
        self._is_closed = True

    def _open(self) -> "InputContainer":
        try:
            _check_content(self._path)
            return open_container(f"file:{self._path}", protocols="file")
        except MissingExtraError:
            raise
        except OSError as error:
            raise InputError(f"{self._path}: {error.strerror or error}") from error
        except InputError as error:
            raise InputError(f"{self._path}: {error}") from error

    def _one_pass(self) -> Iterator[tuple[float, AnyPixels]]:
        count = 0
        with closing(self._open()) as container:
            for time_s, pixels in decoded(container, self._warn, grey=self._grey):
                if self._is_closed:
                    return
                yield self._time(time_s, count), pixels
                count += 1
        self._check_count(count)

    def _time(self, time_s: float | None, count: int) -> float:
        if time_s is not None:
            return time_s
        self._warn(f"no timestamps: counted at {1 / self._interval_s:.6g} images per second")
        return count * self._interval_s

    def _image(self, pixels: AnyPixels, time_s: float, sequence: int) -> Image:
        image = Image(pixels, time_s, "capture", sequence, self.name, self._camera)
        return checked_fit(image)

    def _check_count(self, count: int) -> None:
        if not count:
            raise InputError(f"{self.name}: expected a video, not one image could be decoded")
        if count < self._announced:
            self._warn(f"the file announces {self._announced} images, {count} could be decoded")

    def _warn(self, text: str) -> None:
        self._warnings[text] = None


def _check_content(path: Path) -> None:
    """Refuse text before FFmpeg sees it: it would follow a play list, or film the letters."""
    if not path.is_file() and path.exists():
        raise InputError("expected a video file, found a folder or a device")
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
    if not head or is_text(head):
        raise InputError(f"expected a picture or a video, found {describe(head)}")

"""A recording as a source of images: the same images with the same stamps, once more."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from tagmetry.camera import Camera, Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.record.mcap.images import parse_image
from tagmetry.record.mcap.pieces import MAGIC, require_mcap
from tagmetry.record.mcap.reading import read_entries, warn_of_damage
from tagmetry.record.mcap.topics import IMAGES
from tagmetry.sources.fit import checked_fit


class Replay(Closing):
    """The images of a recording, in order, as quickly as they are taken.

    Stamps, numbers and the name of the source are those of the run that was recorded. A recording
    that was cut off gives all whole images, and a `DamagedRecordingWarning`.
    """

    def __init__(self, path: str | Path, *, camera: Camera | None = None) -> None:
        """Choose the file.

        Raises:
            InputError: It is not there, or no MCAP file.
            MissingExtraError: The part `arena` is not installed.
        """
        require_mcap("reading")
        self.name = str(path)
        self._path, self._camera = Path(path), camera
        self._is_closed = False
        _check_content(self._path)

    @property
    def is_live(self) -> bool:
        """No: every image is given."""
        return False

    @property
    def length(self) -> int | None:
        """None: a recording that was cut off does not say how many images it holds."""
        return None

    def __iter__(self) -> Iterator[Image]:
        """Give the images from the beginning.

        Raises:
            InputError: The recording has none.
        """
        count = 0
        for image in self._whole_images():
            if self._is_closed:
                return
            yield checked_fit(image)
            count += 1
        if not count:
            raise InputError(f"{self.name}: there is no whole image in this recording")

    def _whole_images(self) -> Iterator[Image]:
        for entry in read_entries(self._path, IMAGES):
            try:
                yield replace(parse_image(entry.content), camera=self._camera)
            except InputError as error:
                warn_of_damage(f"{self.name}: passed over an image: {error}")

    def close(self) -> None:
        """End every iteration before its next image."""
        self._is_closed = True


def _check_content(path: Path) -> None:
    try:
        with path.open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise InputError(f"{path}: expected an MCAP file, found something else")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error

"""Still pictures as a source of images: one file, or many in order."""

from collections.abc import Iterator, Sequence
from itertools import count
from pathlib import Path

from tagmetry.camera import Camera, Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.sources.content import HEAD_BYTES, describe, picture_kind
from tagmetry.sources.decode import decode_picture
from tagmetry.sources.fit import checked_fit

MAX_FILE_BYTES = 2**31 - 1  # OpenCV's buffers end here; 200 megapixels of 16-bit colour fit


class Pictures(Closing):
    """Picture files, read one by one when their turn comes.

    A file that cannot be used raises InputError at its turn; the next call of `next` on the same
    iterator gives the picture after it.
    """

    def __init__(
        self,
        paths: Sequence[Path],
        *,
        camera: Camera | None = None,
        grey: bool = False,
        loop: bool = False,
        name: str = "",
    ) -> None:
        if not paths:
            raise InputError("expected at least one picture, got none")
        self._paths, self._camera, self._grey, self._loop = tuple(paths), camera, grey, loop
        self.name = name or str(paths[0])

    @property
    def is_live(self) -> bool:
        """No: every picture is given."""
        return False

    @property
    def length(self) -> int | None:
        """How many pictures there are; None when they are repeated without end."""
        return None if self._loop else len(self._paths)

    def __iter__(self) -> Iterator[Image]:
        """Give the pictures in order."""
        return map(self._image, count() if self._loop else range(len(self._paths)))

    def close(self) -> None:
        """Do nothing: no file stays open."""

    def _image(self, sequence: int) -> Image:
        path = self._paths[sequence % len(self._paths)]
        pixels = read_picture(path, grey=self._grey)
        image = Image(pixels, sequence=sequence, source=str(path), camera=self._camera)
        return checked_fit(image)


def read_picture(path: str | Path, *, grey: bool = False) -> AnyPixels:
    """Return the pixels of a picture file; `decode_picture` says which and how.

    Raises:
        InputError: It cannot be read or used; the text begins with the path.
    """
    try:
        return decode_picture(_content(Path(path)), grey=grey)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _content(path: Path) -> bytes:
    """Read the file, but not a large one that is no picture, nor a pipe that never ends."""
    if not path.is_file() and path.exists():
        raise InputError("expected a picture file, found a folder or a device")
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
        if picture_kind(head) is None:
            return head
        size_bytes = path.stat().st_size
        if size_bytes > MAX_FILE_BYTES:
            raise InputError(f"{describe(head)} of {size_bytes / 1e9:.1f} GB is too large")
        return head + file.read(size_bytes)

"""Overlays as pictures: one file per image, named after it."""

import re
from pathlib import Path

from tagmetry.camera.image import Image
from tagmetry.closing import Closing
from tagmetry.errors import InputError
from tagmetry.files.atomic import refusing, write_atomically

SUFFIXES = (".png", ".jpg", ".jpeg")


class PictureWriter(Closing):
    """Writes each image to a PNG or JPEG file.

    The path may hold `{stem}`, the name of the image's source without its ending, and `{sequence}`,
    its number in the source with six digits. Each file is replaced in one step.
    """

    def __init__(self, path: str | Path) -> None:
        self._path = Path(path)
        self._written: set[Path] = set()

    def write(self, item: Image) -> None:
        """Write one image.

        Raises:
            InputError: It would replace another one of this run.
        """
        path = picture_path(self._path, item)
        if path in self._written:
            raise InputError(
                f"{path} holds an image of this run already; for several images put {{stem}} or "
                f"{{sequence}} into its name, such as {_suggested(self._path)}"
            )
        with refusing(path):
            write_atomically(path, _encoded(item, path))
        self._written.add(path)

    def close(self) -> None:
        """Nothing is open between images."""


def picture_path(pattern: Path, image: Image) -> Path:
    """Return where an image goes: the pattern with its stem and sequence."""
    stem = re.sub(r"[^\w.-]", "_", Path(image.source).stem) or "image"
    filled = str(pattern).replace("{stem}", stem).replace("{sequence}", f"{image.sequence:06d}")
    return Path(filled)


def _encoded(image: Image, path: Path) -> bytes:
    import cv2

    done, content = cv2.imencode(path.suffix.lower(), image.pixels)
    if not done:
        size = f"{image.width_px}x{image.height_px}"
        raise InputError(f"{path}: an image of {size} does not fit this format")
    return bytes(content.tobytes())


def _suggested(path: Path) -> Path:
    return path.with_name(f"{path.stem}_{{stem}}_{{sequence}}{path.suffix}")

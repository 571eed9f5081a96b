"""Overlay files by their suffix."""

from pathlib import Path

from tagmetry.camera.image import Image
from tagmetry.record.formats import unknown_suffix
from tagmetry.record.pictures import SUFFIXES, PictureWriter
from tagmetry.record.video import VideoEncoder
from tagmetry.record.whole import WholeFileWriter, Writer


def open_overlay(path: str | Path) -> Writer[Image]:
    """Return a writer of overlays for the format that the suffix names, for a with-block.

    The images it takes hold what `draw_overlay` returned, with the source, sequence and time of the
    image it was drawn over: `dataclasses.replace(image, pixels=overlay)`.

    Args:
        path: `.png` and `.jpg` give one picture per image, with `{stem}` or `{sequence}` in the
            name where there are several; `.mp4` a video that appears when the block ends.

    Raises:
        InputError: The suffix is another one; later, the file cannot be written.
    """
    suffix = Path(path).suffix.lower()
    if suffix in SUFFIXES:
        return PictureWriter(path)
    if suffix == ".mp4":
        return WholeFileWriter(path, VideoEncoder())
    raise unknown_suffix(path, (*SUFFIXES, ".mp4"))

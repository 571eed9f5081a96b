"""One image and what is known about it."""

from dataclasses import dataclass
from typing import Literal

from tagmetry.camera.model import Camera
from tagmetry.geometry.arrays import AnyPixels

TimeKind = Literal["capture", "arrival", "none"]


@dataclass(frozen=True)
class Image:
    """Pixels with their time and origin.

    Attributes:
        pixels: Grey (height, width) or BGR (height, width, 3), 8 or 16 bits. Never changed.
        time_s: When it was taken, in the source's own clock; 0 where there is no time.
        time_kind: `capture`: middle of the exposure or a video's timestamp; `arrival`: when it
            reached this program; `none`: a still picture without a time.
        sequence: Counts the images of a source from 0; gaps are images that were dropped.
        source: Path, address or device that it came from.
        camera: Intrinsics, where they are known.
    """

    pixels: AnyPixels
    time_s: float = 0.0
    time_kind: TimeKind = "none"
    sequence: int = 0
    source: str = ""
    camera: Camera | None = None

    @property
    def width_px(self) -> int:
        """Number of columns."""
        return int(self.pixels.shape[1])

    @property
    def height_px(self) -> int:
        """Number of rows."""
        return int(self.pixels.shape[0])

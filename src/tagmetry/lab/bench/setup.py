"""What a rendered case is, before it is rendered."""

from dataclasses import dataclass
from typing import Literal

Extent = Literal["quick", "default", "full"]
EXTENTS: tuple[Extent, ...] = ("quick", "default", "full")
FULL_HD = (1920, 1080)
SIZE_M = 0.1  # of the markers
_MIDDLE = 0.47  # of their light, of full scale


@dataclass(frozen=True)
class Setup:
    """What to render.

    Attributes:
        name: What the case is called.
        count: How many markers.
        side_px: Mean length of their sides.
        size_px: Width and height of the images.
        cluttered: Behind them are texture, papers and text; else plain grey.
        noise: Standard deviation of the noise, grey values.
        exponent: Of the camera's response; 1 is linear.
        blur_px: Standard deviation of the point spread.
        images: How many, each with other markers that lie anew.
        is_film: They follow each other instead, and the same markers move.
        extent: From which extent of the bench on it is measured.
        all_threads: It is measured with all threads as well.
        tilt_deg: How far every marker leans, to any side; None for up to 35 about two axes.
        contrast: Light of paper less that of ink, of full scale.
        motion_px: How far the markers move while the shutter is open, in any direction.
        white_electrons: What a white pixel gathers, with the noise of light and of the reading;
            None is light without noise.
    """

    name: str
    count: int = 24
    side_px: float = 60.0
    size_px: tuple[int, int] = FULL_HD
    cluttered: bool = True
    noise: float = 2.0
    exponent: float = 1.0
    blur_px: float = 0.6
    images: int = 1
    is_film: bool = False
    extent: Extent = "full"
    all_threads: bool = False
    tilt_deg: float | None = None
    contrast: float = 0.7
    motion_px: float = 0.0
    white_electrons: float | None = None

    @property
    def is_standard(self) -> bool:
        """It differs from the standard case in size and number only."""
        usual = (self.cluttered, self.noise, self.exponent, self.blur_px, self.images)
        return usual == (True, 2.0, 1.0, 0.6, 1)

    @property
    def levels(self) -> tuple[float, float]:
        """Light of ink and of paper, of full scale."""
        return _MIDDLE - self.contrast / 2, _MIDDLE + self.contrast / 2

    @property
    def levels_grey(self) -> tuple[float, float]:
        """Grey values of ink and of paper."""
        black, white = (255.0 * level ** (1 / self.exponent) for level in self.levels)
        return black, white

"""The rendered cases: which there are, before they are rendered."""

from dataclasses import dataclass
from typing import Literal

Extent = Literal["quick", "default", "full"]
EXTENTS: tuple[Extent, ...] = ("quick", "default", "full")
FULL_HD = (1920, 1080)
SIZE_M = 0.1  # of the markers


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
        images: How many; more than one is a film of moving markers.
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


SETUPS = (
    Setup("count-24", extent="quick", all_threads=True),
    Setup("noise-8", noise=8.0, extent="default"),
    Setup("gamma-60", exponent=2.2, extent="default"),
    Setup("film-24", images=12, extent="quick", all_threads=True),
    Setup("none", count=0, extent="default"),
    Setup("plain", cluttered=False, extent="default"),
    Setup("side-12", side_px=12.0, extent="full"),
    Setup("side-16", side_px=16.0, extent="default"),
    Setup("side-20", side_px=20.0, extent="default"),
    Setup("side-30", side_px=30.0, extent="default"),
    Setup("side-100", side_px=100.0, extent="default"),
    Setup("side-200", count=12, side_px=200.0),
    Setup("count-1", count=1, extent="default"),
    Setup("count-6", count=6),
    Setup("count-96", count=96, side_px=36.0, extent="default"),
    Setup("count-360", count=360, side_px=36.0, extent="default", all_threads=True),
    Setup("noise-0", noise=0.0),
    Setup("noise-16", noise=16.0, extent="default"),
    Setup("noise-8-30", side_px=30.0, noise=8.0),
    Setup("noise-8-100", side_px=100.0, noise=8.0),
    Setup("gamma-30", side_px=30.0, exponent=2.2, extent="default"),
    Setup("gamma-100", side_px=100.0, exponent=2.2),
    Setup("blur-0.3", blur_px=0.3),
    Setup("blur-1.5", blur_px=1.5, extent="default"),
    Setup("size-480p", count=6, size_px=(640, 480), extent="default"),
    Setup("size-720p", count=6, size_px=(1280, 720)),
    Setup("size-4k", size_px=(3840, 2160), all_threads=True),
    Setup("film-96", count=96, side_px=36.0, images=12),
    Setup("film-360", count=360, side_px=36.0, images=12, all_threads=True),
)

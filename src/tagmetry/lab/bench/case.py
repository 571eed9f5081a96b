"""What is measured: images of markers with what is true of them, as far as that is known."""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric.bound import Print
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import GreyPixels, IntArray


@dataclass(frozen=True, eq=False)
class Truth:
    """The markers of an image.

    Attributes:
        ids: Shape (n,).
        corners_px: Shape (n, 4, 2).
        Ts_camera_marker: Their n poses; None where they are not known, or there is no marker.
    """

    ids: IntArray
    corners_px: Array
    Ts_camera_marker: RigidTransform | None = None


def nothing(images: int) -> tuple[Truth, ...]:
    """Return the truth of so many images without any marker."""
    return (Truth(np.empty(0, np.int64), np.empty((0, 4, 2))),) * images


@dataclass(frozen=True, eq=False)
class Seen:
    """How rendered markers are seen: what the Cramer-Rao bound depends on.

    Attributes:
        camera: Intrinsics.
        size_m: Side of the markers.
        black: Grey value of black.
        white: Grey value of white.
        blur_px: Standard deviation of the point spread, besides the pixel's own square.
        exponent: Of the response.
        noise: Standard deviation of the grey values, rounding included.
        motion_px: How far they move while the shutter is open, right and down.
        grey_per_electron: Variance that light itself has, by its grey value.
    """

    camera: Camera
    size_m: float
    black: float
    white: float
    blur_px: float
    exponent: float
    noise: float
    motion_px: tuple[float, float] = (0.0, 0.0)
    grey_per_electron: float = 0.0

    def printed(self, picture: np.ndarray, margin_cells: int) -> Print:
        """Return a marker's picture as it is seen."""
        return Print(
            picture,
            margin_cells,
            self.black,
            self.white,
            self.blur_px,
            self.exponent,
            self.motion_px,
            self.grey_per_electron,
        )


@dataclass(frozen=True, eq=False)
class Case:
    """Images to look at, one after another.

    Attributes:
        name: What it is called.
        family: What to look for.
        images: Each of shape (h, w).
        truths: Of every image; None where the engines must agree among themselves.
        seen: How the markers are seen, where they are rendered.
        is_standard: It differs from the standard case in size and number only, so that the time of
            an image and of a marker can be told apart.
        moves: The images are a film that begins again without a jump.
        once: Each image is looked at once: it is not time that is asked for.
    """

    name: str
    family: str
    images: tuple[GreyPixels, ...]
    truths: tuple[Truth, ...] | None
    seen: Seen | None = None
    is_standard: bool = False
    moves: bool = False
    once: bool = False

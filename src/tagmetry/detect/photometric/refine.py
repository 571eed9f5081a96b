"""Where exactly are markers' corners? Their whole pictures are fitted to the raw pixels.

marker's frame and first numbers (marker) -> pixels beside its edges (pixels) -> what the camera
reports of it (model, ink) fitted by Gauss and Newton (fit) -> corners and covariance (corners)
-> what to believe of bows (bows) -> what to report (outcome).

All edges of all cells tell of the same eight numbers, so the noise of a corner is near the least
possible; edges of both polarities tell the camera's response from the marker's size, so a gamma
curve does not move the sides.

The bound is in `bound`. Reference: J. Kallwies, B. Forkel, H.-J. Wuensche, ICRA 2020, gained from
the same idea along the border of tags.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Self

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric.ink import printed
from tagmetry.detect.photometric.model import LOOK_COUNT
from tagmetry.detect.photometric.outcome import outcomes
from tagmetry.detect.photometric.start import are_squares, first_fits, frames_of
from tagmetry.detect.photometric.straight import lenses_around
from tagmetry.detect.photometric.threads import fit_by_threads
from tagmetry.detect.rows import Rows
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_BOWING_HALF_PX = 21.0  # smaller markers cannot tell a bow from noise


@dataclass(frozen=True, eq=False)
class Picture:
    """What is printed where a marker was found.

    Attributes:
        cells: True is white, shape (m, m).
        margin_cells: How many of them lie outside the square whose corners are measured, per side.
        quiet_zone: White paper is around it. Where not, the outermost cells are there to say what
            blurs into the others, and are not looked at themselves.
    """

    cells: BoolArray
    margin_cells: int = 0
    quiet_zone: bool = True

    @property
    def side_cells(self) -> int:
        """Cells along a side of the square."""
        return len(self.cells) - 2 * self.margin_cells

    @cached_property
    def square(self) -> tuple[float, float]:
        """The first and last cell coordinate of the square, in the ink."""
        outside = 0.5 * (len(self.ink) - self.side_cells)
        return outside, len(self.ink) - outside

    @cached_property
    def ink(self) -> Array:
        """The cells that are modelled, 1 is white; two rings of them are not the marker's own."""
        return printed(self.cells) if self.quiet_zone else self.cells.astype(np.float64)


@dataclass(frozen=True, eq=False)
class Fitted(Rows):
    """Corners of n markers.

    Attributes:
        corners_px: Shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        sound: Whether the picture was found to explain the pixels, shape (n,); where not, the
            corners are those given and the covariance means nothing.
        looks: How light, camera and blur make each look, for the next image's fit to begin with;
            NaN where not sound, shape (n, 11).
    """

    corners_px: Array
    covariances_px2: Array
    sound: BoolArray
    looks: Array

    @classmethod
    def none(cls, corners_px: Array) -> Self:
        """Return what is known before anything is fitted."""
        count = len(corners_px)
        return cls(
            corners_px,
            np.tile(np.eye(8), (count, 1, 1)),
            np.zeros(count, dtype=np.bool_),
            np.full((count, LOOK_COUNT), np.nan),
        )


def fit_pictures(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None = None,
    threads: int | None = None,
    looks: Array | None = None,
) -> Fitted:
    """Fit markers' pictures to an image.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: First guesses, good to about a pixel, clockwise from the picture's top left,
            shape (n, 4, 2).
        pictures: What is printed there, n of them.
        camera: Intrinsics, so that edges are followed along their curves.
        threads: How many to use at most; by default as many as OpenCV does.
        looks: How each looked in the image before, NaN where that is not known, shape (n, 11).
            Fits only begin with it, and are the quicker for it; those places must be good to some
            tenths of a pixel.
    """
    given_px = np.array(corners_px, dtype=np.float64).reshape(-1, 4, 2)
    looks = np.full((len(given_px), LOOK_COUNT), np.nan) if looks is None else looks
    threads = cv2.getNumThreads() if threads is None else threads
    squares = are_squares(given_px)
    if squares.all():
        return _fitted(grey, given_px, pictures, camera, threads, looks)
    which = np.flatnonzero(squares)
    kept = [pictures[int(k)] for k in which]
    fitted = _fitted(grey, given_px[which], kept, camera, threads, looks[which])
    return Fitted.none(given_px).with_some(which, fitted)


def _fitted(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None,
    threads: int,
    looks: Array,
) -> Fitted:
    """Fit the pictures of markers whose first corners are squares."""
    if len(pictures) == 0:
        return Fitted.none(corners_px)
    frames = frames_of(corners_px)
    bowing = (frames[:, 2] >= _BOWING_HALF_PX) & (camera is None)
    lenses, squares = lenses_around(camera, frames), np.array([k.square for k in pictures])
    starts = first_fits(corners_px, frames, lenses, squares, looks)
    fits, places, joints, noises, moves_px = fit_by_threads(
        grey, [k.ink for k in pictures], (starts, frames, lenses, squares, bowing), threads
    )
    return Fitted(*outcomes(fits, places, joints, noises, moves_px, frames, corners_px))

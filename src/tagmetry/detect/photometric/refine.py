"""Where exactly are markers' corners? Their whole pictures are fitted to the raw pixels.

marker's frame and first numbers (marker) -> pixels beside its edges (pixels) -> what the camera
reports of it (model, ink) fitted by Gauss and Newton (fit) -> corners and covariance (corners)
-> what to believe of bows (bows).

All edges of all cells tell of the same eight numbers, so the noise of a corner is near the least
possible; edges of both polarities tell the camera's response from the marker's size, so a gamma
curve does not move the sides.

The bound is in `bound`. Reference: J. Kallwies, B. Forkel, H.-J. Wuensche, ICRA 2020, gained from
the same idea along the border of tags.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric.bows import believed
from tagmetry.detect.photometric.fit import EXPONENTS
from tagmetry.detect.photometric.ink import printed
from tagmetry.detect.photometric.marker import SETTLED_PX
from tagmetry.detect.photometric.model import BLACK, BLUR, BOWS, EXPONENT, LOOK_COUNT, LOOKS
from tagmetry.detect.photometric.start import are_squares, first_fits, frames_of
from tagmetry.detect.photometric.straight import lenses_around
from tagmetry.detect.photometric.threads import fit_by_threads
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray

_FLOOR_PX = 0.0007  # what neither model nor noise describe
_SHARP_PX2 = 0.15  # of a blur, the pixel's own square in it; of sharper ones the floor is higher
_LOST_PX = (2.5, 0.05)  # a corner that moved farther was another's; at least, and of the diagonal
_BOWING_HALF_PX = 21.0  # smaller markers cannot tell a bow from noise
_LEAST_CONTRAST = 4.0  # in noises
_MOST_DEVIATION_PX = 1.5


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
    def ink(self) -> Array:
        """The cells that are modelled, 1 is white; two rings of them are not the marker's own."""
        return printed(self.cells) if self.quiet_zone else self.cells.astype(np.float64)


@dataclass(frozen=True, eq=False)
class Fitted:
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

    def with_some(self, which: IntArray, others: "Fitted") -> "Fitted":
        """Return these with those at `which` replaced, shape (m,)."""
        corners, covariances = self.corners_px.copy(), self.covariances_px2.copy()
        sound, looks = self.sound.copy(), self.looks.copy()
        corners[which], covariances[which] = others.corners_px, others.covariances_px2
        sound[which], looks[which] = others.sound, others.looks
        return Fitted(corners, covariances, sound, looks)


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
    given_px = np.asarray(corners_px, dtype=np.float64).reshape(-1, 4, 2)
    unknown = np.full((len(given_px), LOOK_COUNT), np.nan)
    found = Fitted(
        given_px, np.tile(np.eye(8), (len(given_px), 1, 1)), are_squares(given_px), unknown
    )
    if not found.sound.any():
        return found
    which = np.flatnonzero(found.sound)
    kept = [pictures[int(k)] for k in which]
    threads = cv2.getNumThreads() if threads is None else threads
    looks = unknown if looks is None else looks
    fitted = _fitted(grey, given_px[which], kept, camera, threads, looks[which])
    return found.with_some(which, fitted)


def _fitted(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None,
    threads: int,
    looks: Array,
) -> Fitted:
    """Fit the pictures of markers whose first corners are squares."""
    frames = frames_of(corners_px)
    half_px = frames[:, 2]
    bowing = (half_px >= _BOWING_HALF_PX) & (camera is None)
    lenses, inks = lenses_around(camera, frames), [picture.ink for picture in pictures]
    squares = _squares(inks, pictures)
    starts = first_fits(corners_px, frames, lenses, squares, looks)
    fits, places, joints, noises, moves_px = fit_by_threads(
        grey, inks, (starts, frames, lenses, squares, bowing), threads
    )
    sound = _explains(fits, noises, moves_px)
    covariances = np.where(sound[:, None, None], joints[:, :8, :8], np.eye(8))
    tells = sound & (np.einsum("nii->ni", joints)[:, 8:] > 0).all(axis=1)
    if tells.any():
        places[tells], covariances[tells] = believed(
            places[tells], joints[tells], half_px[tells], fits[tells, BOWS:]
        )
    moved_px = frames[:, None, :2] + half_px[:, None, None] * places
    covariances_px2 = half_px[:, None, None] ** 2 * covariances + _floors_px2(fits, half_px)
    sound &= _plausible(moved_px, covariances_px2, corners_px, half_px)
    looks = np.where(sound[:, None], fits[:, LOOKS], np.nan)
    corners_px = np.where(sound[:, None, None], moved_px, corners_px)
    return Fitted(corners_px, covariances_px2, sound, looks)


def _floors_px2(fits: Array, half_px: Array) -> Array:
    """Return what is added to covariances, shape (n, 8, 8): the more, the sharper the blur."""
    blur_px2 = half_px**2 * np.minimum(fits[:, BLUR], fits[:, BLUR + 2])
    floors_px = _FLOOR_PX * np.maximum(1.0, _SHARP_PX2 / np.maximum(blur_px2, 1e-9)) ** 3
    return np.asarray(floors_px[:, None, None] ** 2 * np.eye(8))


def _squares(inks: Sequence[Array], pictures: Sequence[Picture]) -> Array:
    """Return the first and last cell coordinate of the squares, shape (n, 2)."""
    cells = np.array([len(ink) for ink in inks])
    sides = np.array([picture.side_cells for picture in pictures])
    return np.stack([0.5 * (cells - sides), 0.5 * (cells + sides)], axis=1)


def _explains(fits: Array, noises: Array, moves_px: Array) -> BoolArray:
    """Say which fits settled on a picture whose contrast stands out of the noise, shape (n,)."""
    contrast = 255 * np.abs(fits[:, BLACK + 1] - fits[:, BLACK])
    sound = (moves_px < SETTLED_PX) & (contrast > _LEAST_CONTRAST * noises)
    exponent = fits[:, EXPONENT]
    return np.asarray(sound & (exponent > EXPONENTS[0]) & (exponent < EXPONENTS[1]))


def _plausible(
    corners_px: Array, covariances_px2: Array, first_px: Array, half_px: Array
) -> BoolArray:
    """Say which fits stayed with the marker that they began with, shape (n,)."""
    moved_px = np.linalg.norm(corners_px - first_px, axis=2).max(axis=1)
    deviation2 = np.einsum("nii->ni", covariances_px2)
    within = moved_px < np.maximum(_LOST_PX[0], _LOST_PX[1] * half_px)
    known = ((deviation2 > 0) & (deviation2 < _MOST_DEVIATION_PX**2)).all(axis=1)
    return np.asarray(within & known & np.isfinite(covariances_px2).all(axis=(1, 2)))

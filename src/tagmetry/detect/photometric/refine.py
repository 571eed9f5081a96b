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

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric.bows import believed
from tagmetry.detect.photometric.fit import EXPONENTS
from tagmetry.detect.photometric.ink import printed
from tagmetry.detect.photometric.marker import first_fit, fit_marker, frame_of
from tagmetry.detect.photometric.model import BLACK, BOWS, EXPONENT
from tagmetry.detect.photometric.straight import NO_LENS, lens_around
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_FLOOR_PX = 0.003  # what the model does not describe
_LOST_PX = (2.5, 0.05)  # a corner that moved farther was another's; at least, and of the diagonal
_BOWING_HALF_PX = 21.0  # smaller markers cannot tell a bow from noise
_SETTLED_PX = 0.05  # in the last round
_LEAST_TURN_PX2 = 4.0
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

    @property
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
    """

    corners_px: Array
    covariances_px2: Array
    sound: BoolArray


def fit_pictures(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None = None,
) -> Fitted:
    """Fit markers' pictures to an image.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: First guesses, good to about a pixel, clockwise from the picture's top left,
            shape (n, 4, 2).
        pictures: What is printed there, n of them.
        camera: Intrinsics, so that edges are followed along their curves.
    """
    count = len(corners_px)
    corners, joint = np.zeros((count, 4, 2)), np.tile(np.eye(13), (count, 1, 1))
    frames, bows, sound = np.zeros((count, 3)), np.zeros((count, 5)), np.zeros(count, dtype=bool)
    for i, (first_px, picture) in enumerate(zip(corners_px, pictures, strict=True)):
        if not _is_square(first_px):
            continue
        frames[i] = frame_of(first_px)
        bowing = camera is None and frames[i, 2] >= _BOWING_HALF_PX
        fit, corners[i], joint[i], sound[i] = _fitted(
            grey, first_px, picture, frames[i], camera, bowing
        )
        bows[i] = fit[BOWS:]
    half_px = frames[:, 2]
    tells = sound & (np.einsum("nii->ni", joint)[:, 8:] > 0).all(axis=1)
    covariances = joint[:, :8, :8].copy()
    if tells.any():
        corners[tells], covariances[tells] = believed(
            corners[tells], joint[tells], half_px[tells], bows[tells]
        )
    moved_px = frames[:, None, :2] + half_px[:, None, None] * corners
    covariances_px2 = half_px[:, None, None] ** 2 * covariances + _FLOOR_PX**2 * np.eye(8)
    sound &= _plausible(moved_px, covariances_px2, corners_px, half_px)
    return Fitted(np.where(sound[:, None, None], moved_px, corners_px), covariances_px2, sound)


def _is_square(corners_px: Array) -> bool:
    """Say whether corners go clockwise around an area of some pixels, without a dent."""
    along = np.roll(corners_px, -1, axis=0) - corners_px
    after = np.roll(along, -1, axis=0)
    turn = along[:, 0] * after[:, 1] - along[:, 1] * after[:, 0]
    return bool((turn > _LEAST_TURN_PX2).all())


def _fitted(
    grey: GreyPixels,
    first_px: Array,
    picture: Picture,
    frame: Array,
    camera: Camera | None,
    bows: bool,
) -> tuple[Array, Array, Array, bool]:
    """Return one marker's fit, corners, covariance with bows, and whether it is any good."""
    ink = picture.ink
    first = 0.5 * (len(ink) - picture.side_cells)
    square = (first, first + picture.side_cells)
    lens = NO_LENS if camera is None else lens_around(camera, frame)
    start_places = (first_px - frame[:2]) / frame[2]
    start = first_fit(start_places, lens, square, frame[2])
    fit, places, joint, noise, moved_px = fit_marker(
        grey, ink, start, start_places, frame, lens, square, bows
    )
    contrast = 255 * abs(fit[BLACK + 1] - fit[BLACK])
    sound = moved_px < _SETTLED_PX and contrast > _LEAST_CONTRAST * noise
    sound = sound and EXPONENTS[0] < fit[EXPONENT] < EXPONENTS[1]
    return fit, places, joint, bool(sound)


def _plausible(
    corners_px: Array, covariances_px2: Array, first_px: Array, half_px: Array
) -> BoolArray:
    """Say which fits stayed with the marker that they began with, shape (n,)."""
    moved_px = np.linalg.norm(corners_px - first_px, axis=2).max(axis=1)
    deviation2 = np.einsum("nii->ni", covariances_px2)
    within = moved_px < np.maximum(_LOST_PX[0], _LOST_PX[1] * half_px)
    known = ((deviation2 > 0) & (deviation2 < _MOST_DEVIATION_PX**2)).all(axis=1)
    return np.asarray(within & known & np.isfinite(covariances_px2).all(axis=(1, 2)))

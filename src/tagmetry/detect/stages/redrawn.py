"""A marker drawn again from its corners alone, to hold against what was seen.

The corners stay as they were found; edges between them are straight, or follow the lens where the
camera is known. Levels, blur and response exponent are fitted anew, by another way than the
detector's: the picture is sampled within pixels and blurred, not integrated.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter
from scipy.optimize import least_squares

from tagmetry.camera import Camera
from tagmetry.detect.photometric import Picture
from tagmetry.geometry import Array, apply_homography, square_to_quad
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_FINER = 4  # samples per pixel and direction
_AROUND_PX = 3
_FIRST = (0.8, 0.0)  # blur in pixels, logarithm of the exponent
_LIMITS = ([0.3, -0.7], [4.0, 1.4])


@dataclass(frozen=True, eq=False)
class Redrawn:
    """What was seen of a marker, and what its picture gives.

    Attributes:
        origin_px: The image's place of the first pixel, x and y.
        seen: Grey values, shape (h, w).
        drawn: What the picture gives there; NaN where it says nothing, shape (h, w).
        blur_px: Standard deviation of the blur that fits best.
        exponent: Response exponent that fits best: value = light^(1 / exponent).
    """

    origin_px: tuple[int, int]
    seen: Array
    drawn: Array
    blur_px: float
    exponent: float

    @property
    def residual(self) -> Array:
        """Seen minus drawn, grey values."""
        return self.seen - self.drawn


def redrawn(
    grey: GreyPixels, corners_px: Array, picture: Picture, camera: Camera | None = None
) -> Redrawn:
    """Return a marker drawn from its corners (4, 2), clockwise from the picture's top left."""
    low, high = _box(square_to_quad(corners_px), picture, grey.shape)
    origin = (int(low[0]), int(low[1]))
    seen = grey[origin[1] : int(high[1]) + 1, origin[0] : int(high[0]) + 1].astype(np.float64)
    fine, known = _whiteness(corners_px, picture, camera, origin, seen.shape)

    def drawn_with(numbers: Array) -> Array:
        return _values(_blurred(fine, numbers[0]), seen, known, np.exp(numbers[1]))

    def misfit(numbers: Array) -> Array:
        return np.asarray((drawn_with(numbers) - seen)[known])

    best = least_squares(
        misfit, _FIRST, bounds=_LIMITS, loss="soft_l1", f_scale=5.0, diff_step=[1e-3, 1e-3]
    )
    drawn = np.where(known, drawn_with(best.x), np.nan)
    return Redrawn(origin, seen, drawn, float(best.x[0]), float(np.exp(best.x[1])))


def _box(H: Array, picture: Picture, shape: tuple[int, ...]) -> tuple[Array, Array]:
    """Return the first and last pixel around the picture, x and y, within the image."""
    beyond = picture.margin_cells / picture.side_cells
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * (1 + 2 * beyond) - beyond
    places = apply_homography(H, square)
    limit = np.array([shape[1], shape[0]]) - 1
    low = np.clip(np.floor(places.min(axis=0)) - _AROUND_PX, 0, limit)
    return low, np.clip(np.ceil(places.max(axis=0)) + _AROUND_PX, 0, limit)


def _whiteness(
    corners_px: Array,
    picture: Picture,
    camera: Camera | None,
    origin: tuple[int, int],
    shape: tuple[int, ...],
) -> tuple[Array, BoolArray]:
    """Return the picture sampled within pixels, and which pixels it tells of."""
    height, width = shape
    x = origin[0] + (np.arange(_FINER * width) + 0.5) / _FINER - 0.5
    y = origin[1] + (np.arange(_FINER * height) + 0.5) / _FINER - 0.5
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    H = np.asarray(np.linalg.inv(square_to_quad(_flat(corners_px, camera))), dtype=np.float64)
    cells = apply_homography(H, _flat(places, camera)) * picture.side_cells + picture.margin_cells
    count = len(picture.cells)
    column, row = np.clip(np.floor(cells), -1, count).astype(int).T + 1
    white = np.pad(picture.cells, 1, constant_values=True)[row, column].astype(np.float64)
    beyond = 0.6 if picture.quiet_zone else -1.0  # of a cell that is still the marker's own
    inside = ((cells > -beyond) & (cells < count + beyond)).all(axis=1)
    known = np.asarray(inside.reshape(height, _FINER, width, _FINER).all(axis=(1, 3)))
    return white.reshape(_FINER * height, _FINER * width), known


def _flat(places_px: Array, camera: Camera | None) -> Array:
    """Return places where straight edges are straight: on the plane one in front of the camera."""
    if camera is None:
        return places_px
    rays = camera.unproject(places_px)
    return np.asarray(rays[..., :2] / rays[..., 2:])


def _blurred(fine: Array, blur_px: float) -> Array:
    """Return the means within pixels of a blurred picture."""
    smooth = gaussian_filter(fine, blur_px * _FINER, mode="nearest")
    height, width = (side // _FINER for side in fine.shape)
    return np.asarray(smooth.reshape(height, _FINER, width, _FINER).mean(axis=(1, 3)))


def _values(white: Array, seen: Array, known: BoolArray, exponent: float) -> Array:
    """Return grey values with black and white as the planes of light that fit best."""
    y, x = np.indices(seen.shape) / max(seen.shape)
    terms = np.stack([np.ones_like(x), x, y, white, white * x, white * y], axis=-1)
    light = (np.maximum(seen, 1.0) / 255) ** exponent
    planes = np.linalg.lstsq(terms[known], light[known], rcond=None)[0]
    return np.asarray(255 * np.maximum(terms @ planes, 1e-6) ** (1 / exponent))

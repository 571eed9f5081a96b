"""Markers, one after the other: from first numbers to a fit, from there to corners, covariance.

coarse: some pixels beside where edges are thought to be; place and levels, then everything
fine: all pixels beside where edges are by now; everything, and bows

Of a marker that was measured in the image before, it is known how it looks and, nearly, where it
is: one choice of pixels is enough, and some of them for place and levels. Where that does not do,
it begins anew. What is found rests on the pixels of this image alone.
"""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.behind import reaches_edges, with_surround
from tagmetry.detect.photometric.corners import write_corners
from tagmetry.detect.photometric.fit import fit_pixels, picture_moved_px, variance_beside_edges
from tagmetry.detect.photometric.ink import changes
from tagmetry.detect.photometric.kernel import Narrow, kernel, step
from tagmetry.detect.photometric.model import (
    BLACK,
    BLUR,
    BOWS,
    COUNT,
    EXPONENT,
    FALL,
    SLOPES,
    blur_in_cells,
    cells_at,
)
from tagmetry.detect.photometric.normal import inverse_seen
from tagmetry.detect.photometric.pixels import MOST_BLOCKS, gather
from tagmetry.detect.photometric.view import View
from tagmetry.detect.photometric.windows import set_windows
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels, IntArray

Factor = tuple[Array, Array]  # of a normal matrix, and its scale
JOINT = 8 + COUNT - BOWS  # coordinates of corners, and bows
_FIRST_BLUR_PX = 0.9
_FIRST_NOISE = 20.0
_LEAST_PIXELS = 60
_COARSE_PIXELS, FINE_PIXELS = 250, 1600
_COARSE_BESIDE_PX, BESIDE_PX = 1.5, 0.9  # farther pixels say little of an edge
_COARSE_SPARE_PX, _SPARE_PX = 1.0, 0.2  # that a first guess may be wrong by
# A round that moves the picture less was the last: of place and levels, of all, of all pixels.
_ROUGHLY_PX, _NEARLY_PX, SETTLED_PX = 0.3, 0.05, 0.12
_OTHER_BLUR, _OTHER_EXPONENT = 0.5, 0.2  # its variance as a share; its logarithm
_NEAR_PX = 0.4  # that a first guess may be wrong by where pixels are chosen only once
_FALLING_HALF_PX = 21.0
_COARSE_SIGHT, _SIGHT = 4.5, 6.0  # blurs, both sides of a pixel together


@kernel
def fit_markers(
    grey: GreyPixels,
    inks: Array,
    sizes: IntArray,
    starts: Array,
    frames: Array,
    lenses: Array,
    squares: Array,
    bows: BoolArray,
) -> tuple[Array, Array, Array, Array, Array]:
    """Fit n markers' pictures.

    Args:
        grey: The image.
        inks: Cells of all pictures, row by row, one picture after the other, 1 is white.
        sizes: Cells along a side of each, shape (n,).
        starts: From `first_fits`, shape (n, 24); zeros after the homography where it is not known
            how a marker looks.
        frames: Middle x, y and half diagonal, pixels, shape (n, 3).
        lenses: See `lenses_around`.
        squares: First and last cell coordinate of the squares, shape (n, 2).
        bows: Whether to fit bows, shape (n,).

    Returns:
        The fits (n, 24); corners (n, 4, 2) and the covariances of corners and bows (n, 13, 13), in
        units of the half diagonal, from the middle; noise (grey values, shape (n,)); how far the
        picture moved in the last round (px, shape (n,)), infinite where the fit failed.
    """
    count, first_cell = len(sizes), 0
    fits, places, joints = starts.copy(), np.zeros((count, 4, 2)), np.zeros((count, JOINT, JOINT))
    noises, moves_px = np.zeros(count), np.zeros(count)
    room, pixels = row.new_room(), row.new_pixels(MOST_BLOCKS)
    for k in range(count):
        ink = inks[first_cell : first_cell + sizes[k] ** 2].reshape(sizes[k], sizes[k])
        first_cell += sizes[k] ** 2
        view = View(grey, frames[k], lenses[k], room, pixels)
        square = (squares[k, 0], squares[k, 1])
        noises[k], moves_px[k] = fit_marker(
            view, ink, fits[k], square, bows[k], places[k], joints[k]
        )
    return fits, places, joints, noises, moves_px


@step
def fit_marker(
    view: View,
    ink: Array,
    fit: Array,
    square: tuple[float, float],
    bows: bool,
    places: Array,
    joint: Array,
) -> tuple[float, float]:
    """Write the fit, corners and covariance of one marker; return noise and the last move."""
    numbers = _number_count(bows, view.frame[2])
    noise, moved_px, covariance = 0.0, np.inf, (np.zeros((numbers, numbers)), np.ones(numbers))
    first = fit.copy()
    if fit[BLACK] > 0.0:
        noise, moved_px, covariance = _fit_as_before(view, ink, fit, numbers)
    if not moved_px < SETTLED_PX:
        fit[:BLACK], fit[BLACK:] = first[:BLACK], 0.0
        noise, moved_px, covariance = _fit_anew(view, ink, fit, numbers)
    if np.isfinite(moved_px):
        _write_corners(view, fit, square, covariance, places, joint)
    return noise, moved_px


@step
def _number_count(bows: bool, half_px: float) -> int:
    """Return how many numbers are fitted; across small markers light falls off evenly enough."""
    if bows:
        return COUNT
    return BOWS if half_px >= _FALLING_HALF_PX else FALL


@step
def _fit_as_before(view: View, ink: Array, fit: Array, numbers: int) -> tuple[float, float, Factor]:
    """Improve a fit that begins with how the marker looked in the image before; returns as below.

    The pixels are chosen once, so this holds for first places that are nearly right only.
    """
    if reaches_edges(fit):
        ink = with_surround(view.grey, ink, fit, view.frame, view.lens)
    before = fit.copy()
    count = gather(view, ink, fit, BESIDE_PX, FINE_PIXELS)
    edges = _with_windows(view, ink, fit, count, _SIGHT, _NEAR_PX)
    every = 1 + count // (2 * _COARSE_PIXELS)
    noise, _, _, _ = fit_pixels(view, fit, count, edges, SLOPES, _ROUGHLY_PX, _FIRST_NOISE, every)
    far_px = picture_moved_px(before, fit - before, view.frame[2])
    noise, moved_px, covariance = _finely(view, fit, count, edges, noise, numbers)
    if not far_px < _NEAR_PX or _looks_otherwise(before, fit):
        moved_px = np.inf
    return noise, moved_px, covariance


@step
def _looks_otherwise(before: Array, fit: Array) -> bool:
    """Say whether blur or exponent changed so much that the fit should begin anew."""
    blur = (fit[BLUR] + fit[BLUR + 2]) / (before[BLUR] + before[BLUR + 2])
    changed = abs(fit[EXPONENT] - before[EXPONENT])
    return bool(abs(blur - 1.0) > _OTHER_BLUR or changed > _OTHER_EXPONENT)


@step
def _fit_anew(view: View, ink: Array, fit: Array, numbers: int) -> tuple[float, float, Factor]:
    """Improve a fit of which only the place is known, to a pixel or so; returns as below."""
    noise, moved_px = _fit_coarsely(view, ink, fit)
    if not np.isfinite(moved_px):
        return noise, np.inf, (np.zeros((numbers, numbers)), np.ones(numbers))
    if reaches_edges(fit):
        ink = with_surround(view.grey, ink, fit, view.frame, view.lens)
    count = gather(view, ink, fit, BESIDE_PX, FINE_PIXELS)
    edges = _with_windows(view, ink, fit, count, _SIGHT, _SPARE_PX)
    return _finely(view, fit, count, edges, noise, numbers)


@step
def _fit_coarsely(view: View, ink: Array, fit: Array) -> tuple[float, float]:
    """Improve a fit by some of the pixels; return the noise and how far the picture moved last."""
    fit[BLUR] = fit[BLUR + 2] = (_FIRST_BLUR_PX / view.frame[2]) ** 2
    count = gather(view, ink, fit, _COARSE_BESIDE_PX, _COARSE_PIXELS)
    if count < _LEAST_PIXELS:
        return 0.0, np.inf
    _set_levels(fit, ink, view.pixels, count)
    edges = _with_windows(view, ink, fit, count, _COARSE_SIGHT, _COARSE_SPARE_PX)
    noise, moved_px = _FIRST_NOISE, np.inf
    for numbers in (SLOPES, FALL):
        settled_px = _ROUGHLY_PX if numbers == SLOPES else _NEARLY_PX
        noise, moved_px, _, _ = fit_pixels(view, fit, count, edges, numbers, settled_px, noise)
    return noise, moved_px


@step
def _finely(
    view: View, fit: Array, count: int, edges: int, noise: float, numbers: int
) -> tuple[float, float, Factor]:
    """Improve a fit by all of the chosen pixels.

    Returns:
        The noise; how far the picture moved last (px), infinite where there is no solution; the
        covariance's factor.
    """
    noise, moved_px, L, scale = fit_pixels(view, fit, count, edges, numbers, SETTLED_PX, noise)
    variance = variance_beside_edges(view, fit, count, edges, noise)
    variance *= count / max(count - numbers, 1)
    return noise, moved_px if count >= _LEAST_PIXELS else np.inf, (L, np.sqrt(variance) * scale)


@step
def _write_corners(
    view: View,
    fit: Array,
    square: tuple[float, float],
    covariance: Factor,
    places: Array,
    joint: Array,
) -> None:
    """Write the corners, and the covariance of them and the bows."""
    L, scale = covariance
    numbers = len(scale)
    by_fit = np.zeros((JOINT, numbers))
    write_corners(fit, view.lens, square, places, by_fit)
    for k in range(BOWS, numbers):
        by_fit[8 + k - BOWS, k] = 1.0
    joint[:] = inverse_seen(L, scale, by_fit)


@step
def _with_windows(
    view: View, ink: Array, fit: Array, count: int, sight: float, spare_px: float
) -> int:
    """Write what part of the picture every pixel sees; return how many edges of each direction.

    It sees so many blurs wide, and may be `spare_px` from where the fit has it.
    """
    blur, fineness = blur_in_cells(fit)
    edges = int(np.ceil(sight * blur + 2 * spare_px * fineness / view.frame[2]))
    edges = min(max(edges, 1), row.MOST_EDGES, len(ink) - 1)
    set_windows(view.pixels, count, changes(ink), edges)
    return edges


@step
def _set_levels(fit: Array, ink: Array, pixels: Narrow, count: int) -> None:
    """Set the values of black and white to the means of pixels on such cells."""
    sums, counts = np.zeros(2), np.full(2, 1e-9)
    for k in range(count):
        pixel, p = pixels[k // row.BLOCK], k % row.BLOCK
        u, v, _ = cells_at(fit, pixel[row.X + p], pixel[row.Y + p])
        white = int(ink[int(v), int(u)])
        sums[white] += pixel[row.SEEN + p]
        counts[white] += 1.0
    fit[BLACK] = max(sums[0] / counts[0], 1.0) / 255.0
    fit[BLACK + 1] = max(sums[1] / counts[1], 1.0) / 255.0

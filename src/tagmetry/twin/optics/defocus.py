"""Defocus that changes over the image, as on a tilted sheet.

Each point of the result is the mean over the disc that belongs to it. The image is spread by a few
discs, levels a small factor apart; between two levels a point takes shares of both that are linear
in R^2, so that the second moment, R^2 / 4, is its own. The levels are the same for all images, so
that tiles of one fit together. A disc's rim is thereby softened: at an edge
the error stays below 0.3 % of the contrast. Each level is made only where it is needed.
"""

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array, BoolArray, FloatImage
from tagmetry.twin.optics.spread import Spread, check_grid, spread

_LEVEL_RATIO = 1.1
_LEAST_DISC_PX = 0.25  # smaller ones are shares of it and of none


def spread_by_depth(
    image: FloatImage, fine: int, disc_px: FloatImage | Array, gaussian_px: float = 0.0
) -> FloatImage:
    """Return an image spread by a disc of another radius at every point, and by one Gaussian.

    Args:
        image: Light, shape (height * fine, width * fine).
        fine: Points of the grid along a pixel's side.
        disc_px: Radius of the disc at every point, pixels, shape of the image; 0 is in focus.
        gaussian_px: Standard deviation of the Gaussian that everything is spread by.
    """
    check_grid(image, fine)
    if disc_px.shape != image.shape:
        raise InputError(f"expected radii of shape {image.shape}, got {disc_px.shape}")
    least, most = float(np.min(disc_px)), float(np.max(disc_px))
    if not (np.isfinite(most) and least >= 0):
        raise InputError(f"defocus radii must be finite and not negative, got {least} to {most}")
    levels = _levels_px(least, most)
    if len(levels) == 1:
        return spread(image, fine, Spread(gaussian_px, levels[0]))
    place = _place_among(disc_px, levels)
    result = np.zeros_like(image)
    for level, (rows, columns) in enumerate(_windows(place, len(levels), fine)):
        if rows.start < rows.stop and columns.start < columns.stop:
            share = np.maximum(1 - np.abs(place[rows, columns] - np.float32(level)), 0)
            by = Spread(gaussian_px, levels[level])
            result[rows, columns] += share * _spread_within(image, rows, columns, fine, by)
    return result


def _levels_px(least_px: float, most_px: float) -> list[float]:
    """Return the levels around radii from the least to the greatest."""
    if least_px == most_px:
        return [least_px]
    first, last = (_steps(radius_px) for radius_px in (least_px, most_px))
    steps = range(int(np.floor(first)), int(np.ceil(last)) + 1)
    return [_LEAST_DISC_PX * _LEVEL_RATIO**step if step >= 0 else 0.0 for step in steps]


def _steps(radius_px: float) -> float:
    """Return a radius as a number of levels above the least disc; -1 is in focus."""
    if radius_px < _LEAST_DISC_PX:
        return float(radius_px / _LEAST_DISC_PX - 1)
    return float(np.log(radius_px / _LEAST_DISC_PX) / np.log(_LEVEL_RATIO))


def _place_among(disc_px: FloatImage | Array, levels_px: list[float]) -> FloatImage:
    """Return the place of every radius among the levels, linear in its square between two."""
    squared = np.asarray(disc_px, np.float64) ** 2
    place = np.interp(squared, np.square(levels_px), np.arange(len(levels_px)))
    return np.asarray(place, np.float32)


def _windows(place: FloatImage, levels: int, fine: int) -> list[tuple[slice, slice]]:
    """Return for every level the rows and columns around the points that have a share of it."""
    least, most = ([extreme(place, axis=axis) for axis in (1, 0)] for extreme in (np.min, np.max))
    spans = [
        [_span((low < level + 1) & (high > level - 1), fine) for level in range(levels)]
        for low, high in zip(least, most, strict=True)
    ]
    return list(zip(*spans, strict=True))


def _span(used: BoolArray, fine: int) -> slice:
    """Return the whole pixels of one axis that hold used points, in points of the grid."""
    at = np.flatnonzero(used)
    return (
        slice(int(at[0]) // fine * fine, (int(at[-1]) // fine + 1) * fine)
        if len(at)
        else slice(0, 0)
    )


def _spread_within(
    image: FloatImage, rows: slice, columns: slice, fine: int, by: Spread
) -> FloatImage:
    """Return a window of the image spread, made from a cut-out as wide as the kernel needs."""
    reach = fine * (int(np.ceil(by.disc_px + 5 * by.gaussian_px)) + 1)
    top, left = max(rows.start - reach, 0), max(columns.start - reach, 0)
    cut = np.ascontiguousarray(image[top : rows.stop + reach, left : columns.stop + reach])
    done = spread(cut, fine, by)
    return done[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left]

"""The best that can be said of corners: whole pictures where they fit, else the sides alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric import LOOK_COUNT, Picture, fit_pictures
from tagmetry.detect.sides import Corners, refine
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels


@dataclass(frozen=True)
class Exact(Corners):
    """Corners of n markers, and how the markers look.

    Attributes:
        looks: Numbers of the photometric fit, NaN where the sides alone told, shape (n, 11); a fit
            to the next image may begin with them.
    """

    looks: Array

    @classmethod
    def nothing(cls) -> Self:
        """Return no corners."""
        none = np.zeros((0, 4, 2)), np.zeros((0, 8, 8)), np.zeros(0, dtype=bool)
        return cls(*none, np.zeros((0, LOOK_COUNT)))


def exact_corners(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None = None,
    looks: Array | None = None,
) -> Exact:
    """Refine corners to about the least error that the noise allows.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: First guesses, good to about a pixel, clockwise, shape (n, 4, 2).
        pictures: What is printed in each, n of them.
        camera: Intrinsics, so that edges are followed along their curves.
        looks: How each looked in the image before, see `fit_pictures`.
    """
    found = _fitted(grey, corners_px, pictures, camera, looks)
    rest = np.flatnonzero(~found.refined)
    if not len(rest):
        return found
    return found.with_some(
        rest, _by_sides(grey, corners_px[rest], [pictures[int(k)] for k in rest], camera)
    )


def _fitted(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None,
    looks: Array | None = None,
) -> Exact:
    fitted = fit_pictures(grey, corners_px, pictures, camera, looks=looks)
    return Exact(fitted.corners_px, fitted.covariances_px2, fitted.sound, fitted.looks)


def _by_sides(
    grey: GreyPixels, corners_px: Array, pictures: Sequence[Picture], camera: Camera | None
) -> Exact:
    """Return what sides alone tell, and where whole pictures fit from there, what those tell.

    A finger over a corner leads the first guess of it astray, more than a side that passes it.
    """
    cells = np.array([picture.side_cells for picture in pictures])
    sides = refine(grey, corners_px, cells, camera)
    unknown = np.full((len(sides), LOOK_COUNT), np.nan)
    alone = Exact(sides.corners_px, sides.covariances_px2, sides.refined, unknown)
    whole = _fitted(grey, sides.corners_px, pictures, camera)
    return alone.with_some(np.flatnonzero(whole.refined), whole.at(whole.refined))

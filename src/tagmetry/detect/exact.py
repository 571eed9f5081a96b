"""The best that can be said of corners: whole pictures where they fit, else the sides alone."""

from collections.abc import Sequence

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect.photometric import Picture, fit_pictures
from tagmetry.detect.refine import Corners, refine
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels


def exact_corners(
    grey: GreyPixels,
    corners_px: Array,
    pictures: Sequence[Picture],
    camera: Camera | None = None,
) -> Corners:
    """Refine corners to about the least error that the noise allows.

    Args:
        grey: 8-bit image, shape (height, width).
        corners_px: First guesses, good to about a pixel, clockwise, shape (n, 4, 2).
        pictures: What is printed in each, n of them.
        camera: Intrinsics, so that edges are followed along their curves.
    """
    fitted = fit_pictures(grey, corners_px, pictures, camera)
    if fitted.sound.all():
        return Corners(fitted.corners_px, fitted.covariances_px2, fitted.sound)
    rest = ~fitted.sound
    cells = np.array([picture.side_cells for picture in pictures])
    sides = refine(grey, corners_px[rest], cells[rest], camera)
    corners, covariances = fitted.corners_px.copy(), fitted.covariances_px2.copy()
    refined = fitted.sound.copy()
    corners[rest], covariances[rest] = sides.corners_px, sides.covariances_px2
    refined[rest] = sides.refined
    return Corners(corners, covariances, refined)

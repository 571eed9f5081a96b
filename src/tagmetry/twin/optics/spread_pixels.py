"""Pixels of a spread image in one pass: `pixel_means` of `spread`, several times faster.

The Gaussian and the mean over a pixel are one kernel of weights along each axis, and only the
pixels themselves are computed: first over rows, then along what that leaves.
"""

import numpy as np
from numba import njit

from tagmetry.geometry.arrays import FloatImage
from tagmetry.twin.optics.spread import Spread, check_grid, gaussian_kernel, pixel_means, spread


def spread_pixels(image: FloatImage, fine: int, by: Spread) -> FloatImage:
    """Return the pixels of a spread image.

    Args:
        image: Light, shape (height * fine, width * fine), each point the mean over its area.
        fine: Points of the grid along a pixel's side.
        by: The point spread. A disc has no kernel along an axis and takes the long way.

    Returns:
        Shape (height, width).
    """
    if by.disc_px > 0 or by.gaussian_px == 0:
        return pixel_means(spread(image, fine, by), fine)
    check_grid(image, fine)
    weights = np.convolve(gaussian_kernel(by.gaussian_px * fine), np.full(fine, 1 / fine))
    return np.asarray(_gathered(np.ascontiguousarray(image), weights.astype(np.float32), fine))


@njit(cache=True, nogil=True)
def _gathered(image: FloatImage, weights: FloatImage, fine: int) -> FloatImage:
    """Return every pixel's weighted sum; the border goes on as it ends."""
    height, width = image.shape
    reach = (len(weights) - fine) // 2
    pixels = np.zeros((height // fine, width // fine), np.float32)
    line = np.empty(width + 2 * reach, np.float32)
    for row in range(height // fine):
        line[:] = 0
        inner = line[reach : reach + width]
        for k in range(len(weights)):
            inner += weights[k] * image[min(max(row * fine + k - reach, 0), height - 1)]
        line[:reach], line[reach + width :] = inner[0], inner[-1]
        _along(line, weights, fine, pixels[row])
    return pixels


@njit(cache=True, nogil=True)
def _along(line: FloatImage, weights: FloatImage, fine: int, out: FloatImage) -> None:
    """Add the weighted sums of every `fine`-th place of a line to `out`."""
    for k in range(len(weights)):
        for column in range(len(out)):
            out[column] += weights[k] * line[column * fine + k]

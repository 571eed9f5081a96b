"""Rays between the pixels' corners, by cubic interpolation.

A lens bends smoothly: over one pixel the fourth differences of its rays, which cubics leave out,
are far below a millionth of a pixel.
"""

import numpy as np
from numba import njit

from tagmetry.geometry import Array


def finer(rays: Array, fine: int) -> Array:
    """Return rays at `fine` steps from each corner of a pixel to the next.

    Args:
        rays: At the corners of h x w pixels and one more on every side, shape (h + 3, w + 3, 3).
        fine: How many steps.

    Returns:
        Shape (fine * h + 1, fine * w + 1, 3).
    """
    if fine == 1:
        return np.ascontiguousarray(rays[1:-1, 1:-1])
    weights = _weights(np.arange(fine) / fine)
    return _along_rows(_along_columns(np.ascontiguousarray(rays), weights), weights)


def _weights(t: Array) -> Array:
    """Return the weights of the values at -1, 0, 1 and 2 of the cubic through them, at t."""
    first = -t * (t - 1) * (t - 2) / 6
    second = (t + 1) * (t - 1) * (t - 2) / 2
    third = -(t + 1) * t * (t - 2) / 2
    fourth = (t + 1) * t * (t - 1) / 6
    return np.stack([first, second, third, fourth], axis=-1)


@njit(cache=True, nogil=True)
def _along_columns(rays: Array, weights: Array) -> Array:
    height, width, fine = rays.shape[0], rays.shape[1] - 3, len(weights)
    done = np.empty((height, fine * width + 1, 3))
    for row in range(height):
        for column in range(width):
            for step in range(fine):
                for axis in range(3):
                    value = 0.0
                    for k in range(4):
                        value += weights[step, k] * rays[row, column + k, axis]
                    done[row, fine * column + step, axis] = value
        done[row, fine * width] = rays[row, width + 1]
    return done


@njit(cache=True, nogil=True)
def _along_rows(rays: Array, weights: Array) -> Array:
    height, width, fine = rays.shape[0] - 3, rays.shape[1], len(weights)
    done = np.empty((fine * height + 1, width, 3))
    for row in range(height):
        for step in range(fine):
            a, b, c, d = weights[step]
            for column in range(width):
                for axis in range(3):
                    done[fine * row + step, column, axis] = (
                        a * rays[row, column, axis]
                        + b * rays[row + 1, column, axis]
                        + c * rays[row + 2, column, axis]
                        + d * rays[row + 3, column, axis]
                    )
    done[fine * height] = rays[height + 1]
    return done

"""Robots below their markers, compiled: from where squares lie to centres and headings.

    heading = f - turn,   (x, y) = (x_marker, y_marker) - R(heading) (forward, left)

so that with (a, b) = R(heading) (forward, left) a robot moves with its marker by

    J = [[1, 0, b], [0, 1, -a], [0, 0, 1]]
"""

import numpy as np

from tagmetry.arena.compiled import carried, kernel, wrapped_rad
from tagmetry.arena.square_fit import FREEDOM
from tagmetry.geometry import Array

_POOR_CHI2 = 20.5  # one good fit of a thousand is worse

Squares = tuple[Array, Array, Array, Array, Array]


@kernel
def centred(
    squares: Squares, mounts: Array, camera_covariance: Array
) -> tuple[Array, Array, Array]:
    """Return robots' places (n, 3), and their covariances from noise and in common (n, 3, 3).

    Args:
        squares: Places, noise, by_camera, by_height and chi2 of `SquareFits`.
        mounts: Size, height, its standard deviation, forward, left and turn, shape (n, 6).
        camera_covariance: Of the camera's pose, shape (6, 6).
    """
    markers, noises, by_camera, by_height, chi2 = squares
    places, noise, common = np.empty(markers.shape), np.empty(noises.shape), np.empty(noises.shape)
    for n in range(len(markers)):
        J = _place(markers[n], mounts[n], places[n])
        poor = chi2[n] / FREEDOM if chi2[n] > _POOR_CHI2 else 1.0
        noise[n] = carried(J, poor * noises[n])
        shared = carried(by_camera[n], camera_covariance)
        for i in range(3):
            for j in range(3):
                shared[i, j] += mounts[n, 2] ** 2 * by_height[n, i] * by_height[n, j]
        common[n] = carried(J, shared)
    return places, noise, common


@kernel
def _place(marker: Array, mount: Array, place: Array) -> Array:
    """Fill in a robot's place; return how it moves with its marker, shape (3, 3)."""
    heading = marker[2] - mount[5]
    cosine, sine = np.cos(heading), np.sin(heading)
    a = cosine * mount[3] - sine * mount[4]
    b = sine * mount[3] + cosine * mount[4]
    place[0], place[1] = marker[0] - a, marker[1] - b
    place[2] = wrapped_rad(heading)
    J = np.eye(3)
    J[0, 2], J[1, 2] = b, -a
    return J

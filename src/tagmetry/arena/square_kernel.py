"""The fit of squares on level planes, compiled: an image has a hundred of them.

For each square the whitened columns M = L^-1 [r, H, c, C], with L L^T the corners' covariance, r
what they are off by, and H, c and C how they move with the place, the height and the camera's pose.
All that is asked for follows from M^T M:

    noise = (H^T H)^-1,   step = noise H^T r,   chi2 = r^T r - r^T H step
    by height: -noise H^T c,   by camera: -noise H^T C
"""

import numpy as np

from tagmetry.arena.compiled import dot, inverted, kernel, times
from tagmetry.geometry import Array
from tagmetry.localize.joint.small import add_square, cholesky, forward

_OFF, _PLACE, _HEIGHT, _CAMERA, _COLUMNS = 0, 1, 4, 5, 11  # where columns begin, and their number
_FORWARD = np.array([0.5, 0.5, -0.5, -0.5])  # of the corners, in sides
_LEFT = np.array([0.5, -0.5, -0.5, 0.5])

Seen = tuple[Array, Array, Array, Array, Array]
Placed = tuple[Array, Array, Array, Array]
Judged = tuple[Array, Array, Array]


@kernel
def fit_all(seen: Seen, camera: tuple[Array, Array], placed: Placed, judged: Judged) -> None:
    """Fill in the fits of n squares; those that cannot be placed are left as they are.

    Args:
        seen: Unit rays in the camera's frame (n, 4, 3), d(pixel) / d(point) at distance one
            (n, 4, 2, 3), covariances of the corners (n, 8, 8), sizes (n,) and heights (n,).
        camera: R_world_camera and the camera's place, m.
        placed: Places, noise, by_camera and by_height of `SquareFits`.
        judged: Its higher_m, higher_sd_m and chi2.
    """
    rays, by_point, covariances, sizes, heights = seen
    points, M, L = np.empty((4, 2)), np.empty((8, _COLUMNS)), np.zeros((8, 8))
    for n in range(len(rays)):
        if not _met(rays[n], by_point[n], heights[n], camera, points, M):
            continue
        place = placed[0][n]
        if not cholesky(covariances[n], L):
            continue
        _start(points, place)
        _fill_place(points, sizes[n], place, M)
        forward(L, M)
        gram = np.zeros((_COLUMNS, _COLUMNS))
        add_square(M, gram, 1.0)
        if not _solved(gram, n, placed, judged):
            place[:] = np.nan


@kernel
def _met(
    rays: Array,
    by_point: Array,
    height_m: float,
    camera: tuple[Array, Array],
    points: Array,
    M: Array,
) -> bool:
    """Fill in where four rays meet the plane, and the columns of height and camera."""
    R, origin = camera
    by_world, arm = np.empty(3), np.empty(3)
    for c in range(4):
        x, y, z = rays[c]
        for k in range(3):
            arm[k] = R[k, 0] * x + R[k, 1] * y + R[k, 2] * z
        away_m = (height_m - origin[2]) / arm[2]
        if not 0.0 < away_m < np.inf:
            return False
        for k in range(3):
            arm[k] *= away_m
        points[c, 0], points[c, 1] = origin[0] + arm[0], origin[1] + arm[1]
        for axis in range(2):
            a, b, d = by_point[c, axis]
            for k in range(3):
                by_world[k] = (a * R[k, 0] + b * R[k, 1] + d * R[k, 2]) / away_m
            _fill_row(by_world, arm, M[2 * c + axis])
    return True


@kernel
def _fill_row(by_world: Array, arm: Array, row: Array) -> None:
    """Fill in how a pixel moves with (x, y), the height and the camera's pose."""
    row[_PLACE], row[_PLACE + 1], row[_HEIGHT] = by_world
    for k in range(3):
        after, before = (k + 1) % 3, (k + 2) % 3
        row[_CAMERA + k] = -by_world[k]
        row[_CAMERA + 3 + k] = by_world[after] * arm[before] - by_world[before] * arm[after]


@kernel
def _start(points: Array, place: Array) -> None:
    """Fill in the place and direction of the square through four points, near enough."""
    ahead, aside = np.zeros(2), np.zeros(2)
    place[:] = 0.0
    for c in range(4):
        for axis in range(2):
            place[axis] += points[c, axis] / 4.0
            ahead[axis] += 2.0 * _FORWARD[c] * points[c, axis]
            aside[axis] += 2.0 * _LEFT[c] * points[c, axis]
    place[2] = np.arctan2(ahead[1] - aside[0], ahead[0] + aside[1])


@kernel
def _fill_place(points: Array, size_m: float, place: Array, M: Array) -> None:
    """Fill in what the corners are off by, and how they move with the direction."""
    cosine, sine = size_m * np.cos(place[2]), size_m * np.sin(place[2])
    for c in range(4):
        x = cosine * _FORWARD[c] - sine * _LEFT[c]
        y = sine * _FORWARD[c] + cosine * _LEFT[c]
        off_x, off_y = points[c, 0] - place[0] - x, points[c, 1] - place[1] - y
        for row in (M[2 * c], M[2 * c + 1]):
            by_x, by_y = row[_PLACE], row[_PLACE + 1]
            row[_OFF] = by_x * off_x + by_y * off_y
            row[_PLACE + 2] = by_y * x - by_x * y


@kernel
def _solved(gram: Array, n: int, placed: Placed, judged: Judged) -> bool:
    """Fill in all that the products of a square's columns tell."""
    places, noise, by_camera, by_height = placed
    place = slice(_PLACE, _PLACE + 3)
    if not inverted(gram[place, place], noise[n]):
        return False
    off, raised, moved = gram[place, _OFF], gram[place, _HEIGHT], gram[place, _CAMERA:]
    step = times(noise[n], off)
    places[n] += step
    by_height[n] = -times(noise[n], raised)
    for k in range(6):
        by_camera[n, :, k] = -times(noise[n], moved[:, k])
    told = gram[_HEIGHT, _HEIGHT] + dot(by_height[n], raised)
    judged[0][n] = (gram[_HEIGHT, _OFF] + dot(by_height[n], off)) / told
    judged[1][n] = 1.0 / np.sqrt(told)
    judged[2][n] = gram[_OFF, _OFF] - dot(step, off)
    return True

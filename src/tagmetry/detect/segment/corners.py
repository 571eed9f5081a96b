"""Four lines along an outline, and the corners where they meet.

The outline's point farthest from its middle is a corner, and so is the one farthest from that. The
other two are where the outline strays farthest from the lines between those found already. It has
four sides if it strays nowhere far from the lines between the four. Each side is then fitted to the
points between its corners, their ends left out.
"""

import numpy as np
from numba import njit

from tagmetry.geometry.arrays import Array, IntArray

_STRAIGHT = 0.03  # how far an outline may stray from four lines, as a share of its length
_STRAIGHT_PX = 1.0
_ROUGH = 0.02  # how far points may lie from their side's line, as a share of its length, rms
_ROUGH_PX = 0.6
_LEAST_ANGLE_SINE = 0.2


@njit(cache=True, nogil=True)
def far_points(points: Array, slack_px: float, indices: IntArray, strays: Array) -> bool:
    """Write which points of an outline are its corners; say whether it has four sides.

    Args:
        points: Closed, clockwise as seen, shape (n, 2).
        slack_px: How much farther than usual the outline may stray from its sides.
        indices: For the result, in order, shape (5,); the last is the first again, n later.
        strays: To work with, shape (2, 4): how far the outline strays from each line, and where.
    """
    n = len(points)
    across = points[n // 2]
    begin = _farthest(points, (points[0, 0] + across[0]) / 2, (points[0, 1] + across[1]) / 2)
    indices[:] = begin + n
    indices[0] = begin
    indices[1] = _farthest(points, points[begin, 0], points[begin, 1])
    if indices[1] < begin:
        indices[1] += n
    stray, at = strays
    for k in range(2):
        stray[k], at[k] = _strays(points, indices[k], indices[k + 1])
    for known in range(2, 4):
        worst = stray[:known].argmax()
        for k in range(known, worst, -1):
            indices[k + 1], stray[k], at[k] = indices[k], stray[k - 1], at[k - 1]
        indices[worst + 1] = int(at[worst])
        for k in range(worst, worst + 2):
            stray[k], at[k] = _strays(points, indices[k], indices[k + 1])
    return bool(stray.max() <= slack_px + max(_STRAIGHT_PX, _STRAIGHT * _way(points, indices)))


@njit(cache=True, nogil=True)
def four_corners(points: Array, indices: IntArray, outset_px: float, corners: Array) -> bool:
    """Write where the four lines fitted to an outline meet; say whether they make a square.

    Args:
        points: Closed, clockwise as seen, shape (n, 2).
        indices: As `far_points` gives them, shape (5,).
        outset_px: How far outside the outline the sides are.
        corners: For the result, clockwise as seen, shape (4, 2).
    """
    lines = np.empty((4, 4))
    for side in range(4):
        if indices[side + 1] - indices[side] < 4:
            return False
        if not _fit_line(points, indices[side], indices[side + 1], outset_px, lines[side]):
            return False
    return _meet(lines, corners)


@njit(cache=True, nogil=True)
def _farthest(points: Array, x: float, y: float) -> int:
    best, farthest2 = 0, -1.0
    for i in range(len(points)):
        distance2 = (points[i, 0] - x) ** 2 + (points[i, 1] - y) ** 2
        if distance2 > farthest2:
            best, farthest2 = i, distance2
    return best


@njit(cache=True, nogil=True)
def _strays(points: Array, begin: int, end: int) -> tuple[float, int]:
    """Return how far the outline strays from the chord between two of its points, and where."""
    n = len(points)
    from_x, from_y = points[begin % n]
    along_x, along_y = points[end % n, 0] - from_x, points[end % n, 1] - from_y
    length = max(np.sqrt(along_x**2 + along_y**2), 1e-9)
    worst, at = -1.0, begin
    for i in range(begin, end):
        j = i if i < n else i - n
        across = (points[j, 0] - from_x) * along_y - (points[j, 1] - from_y) * along_x
        if abs(across) > worst:
            worst, at = abs(across), i
    return worst / length, at


@njit(cache=True, nogil=True)
def _way(points: Array, indices: IntArray) -> float:
    n, way = len(points), 0.0
    for k in range(4):
        a, b = points[indices[k] % n], points[indices[(k + 1) % 4] % n]
        way += np.sqrt((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2)
    return way


@njit(cache=True, nogil=True)
def _fit_line(points: Array, begin: int, end: int, outset_px: float, line: Array) -> bool:
    """Write (point, unit direction) of a side's least-squares line; say whether it is straight."""
    n = len(points)
    trim = (end - begin) // 8
    from_x, from_y = points[begin % n]
    x = y = xx = xy = yy = 0.0
    for i in range(begin + trim, end - trim):
        j = i if i < n else i - n
        dx, dy = points[j, 0] - from_x, points[j, 1] - from_y
        x, y = x + dx, y + dy
        xx, xy, yy = xx + dx * dx, xy + dx * dy, yy + dy * dy
    each = 1.0 / (end - begin - 2 * trim)
    x, y = x * each, y * each
    xx, xy, yy = xx * each - x * x, xy * each - x * y, yy * each - y * y
    chord_x, chord_y = points[end % n, 0] - from_x, points[end % n, 1] - from_y
    ux, uy, across2 = _principal(xx, xy, yy)
    if ux * chord_x + uy * chord_y < 0:
        ux, uy = -ux, -uy
    line[0], line[1] = from_x + x + outset_px * uy, from_y + y - outset_px * ux
    line[2], line[3] = ux, uy
    return bool(across2 <= max(_ROUGH_PX**2, _ROUGH**2 * (chord_x**2 + chord_y**2)))


@njit(cache=True, nogil=True)
def _principal(xx: float, xy: float, yy: float) -> tuple[float, float, float]:
    """Return the unit direction in which points of such second moments spread, and how far across.

    The latter is the mean square across the direction, the lesser eigenvalue. The direction is the
    longer of two that are the same but for rounding; (0, 0) where all points are one.
    """
    apart = np.sqrt((xx - yy) ** 2 + 4 * xy * xy)
    flat = xx >= yy
    ux, uy = (apart + xx - yy, 2 * xy) if flat else (2 * xy, apart + yy - xx)
    inverse = 1.0 / max(np.sqrt(ux * ux + uy * uy), 1e-30)
    return ux * inverse, uy * inverse, 0.5 * (xx + yy - apart)


@njit(cache=True, nogil=True)
def _meet(lines: Array, corners: Array) -> bool:
    """Write where each line meets the one before it; say whether they turn right every time."""
    for k in range(4):
        ax, ay, ux, uy = lines[k - 1]
        bx, by, vx, vy = lines[k]
        sine = ux * vy - uy * vx
        if sine < _LEAST_ANGLE_SINE:
            return False
        along = ((bx - ax) * vy - (by - ay) * vx) / sine
        corners[k, 0], corners[k, 1] = ax + along * ux, ay + along * uy
    return True

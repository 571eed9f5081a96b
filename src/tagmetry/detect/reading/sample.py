"""Grey values between pixels, and how an image steps across the sides of squares.

Many places are looked up at once: which pixels they are between, what these are, what lies between
them. Of these three loops the first and the last compute several places at a time; together they
would not.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

Narrow = NDArray[np.float32]
_ALONG = np.linspace(0.05, 0.95, 10)  # places along each side where steps are looked at
STEPS = 4 * len(_ALONG)
_ONE = np.uint64(1)
_NEARLY_ONE = 1.001  # a place is between a pixel and the next: before the last
_f32 = np.float32


class Room(NamedTuple):
    """Places to look up, and what is there.

    Attributes:
        x: Columns of the places; once looked up, what of them is past a pixel, shape (n,).
        y: Rows, likewise, shape (n,).
        pixel: That pixel's number, row by row, shape (n,).
        around: It, and those to the right, below, and right below, shape (4, n).
        values: Grey values, shape (n,).
    """

    x: Narrow
    y: Narrow
    pixel: "NDArray[np.int32]"
    around: GreyPixels
    values: Narrow


@njit(cache=True, nogil=True)
def new_room(count: int) -> Room:
    """Return room for so many places."""
    return Room(
        np.empty(count, np.float32),
        np.empty(count, np.float32),
        np.empty(count, np.int32),
        np.empty((4, count), np.uint8),
        np.empty(count, np.float32),
    )


@njit(cache=True, nogil=True)
def look_up(grey: GreyPixels, room: Room, count: int) -> None:
    """Write the grey values at the first places of a room; outside, the image's edge is repeated.

    Args:
        grey: 8-bit image.
        room: Its x and y are used up.
        count: How many places.
    """
    _find_pixels(grey, room, count)
    _take_pixels(grey, room, count)
    _mix_pixels(room, count)


@njit(cache=True, nogil=True)
def _find_pixels(grey: GreyPixels, room: Room, count: int) -> None:
    last_x, last_y = _f32(grey.shape[1] - _NEARLY_ONE), _f32(grey.shape[0] - _NEARLY_ONE)
    width = np.int32(grey.shape[1])
    for k in range(count):
        x = min(max(_f32(0), room.x[k]), last_x)  # in this order, what is no number becomes 0
        y = min(max(_f32(0), room.y[k]), last_y)
        column, row = np.int32(x), np.int32(y)
        room.x[k], room.y[k] = x - _f32(column), y - _f32(row)
        room.pixel[k] = row * width + column


@njit(cache=True, nogil=True)
def _take_pixels(grey: GreyPixels, room: Room, count: int) -> None:
    pixels, down, around = grey.ravel(), np.uint64(grey.shape[1]), room.around
    for k in range(count):
        own = np.uint64(room.pixel[k])
        around[0, k], around[1, k] = pixels[own], pixels[own + _ONE]
        around[2, k], around[3, k] = pixels[own + down], pixels[own + down + _ONE]


@njit(cache=True, nogil=True)
def _mix_pixels(room: Room, count: int) -> None:
    around = room.around
    for k in range(count):
        own, right = _f32(around[0, k]), _f32(around[1, k])
        below, right_below = _f32(around[2, k]), _f32(around[3, k])
        high = own + room.x[k] * (right - own)
        low = below + room.x[k] * (right_below - below)
        room.values[k] = high + room.y[k] * (low - high)


def taps_of(at: Array, reach: float) -> Narrow:
    """Return the four places around each point (k, 2) of a square, shape (2, 4 k).

    Args:
        at: Points of the unit square.
        reach: How far beside and above each point they are, sides of the square.
    """
    corners = reach * np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])
    return np.ascontiguousarray((corners[:, None] + at).reshape(-1, 2).T, dtype=np.float32)


def cell_means(grey: GreyPixels, H: Array, at: Array, reach: float) -> Array:
    """Return the mean of four places around each point of a square, shape (n, k).

    Args:
        grey: 8-bit image.
        H: From the unit square to pixels, shape (n, 3, 3).
        at: Points of the unit square, shape (k, 2).
        reach: How far beside and above each point it is looked at, sides of the square.
    """
    return _cell_means(grey, np.ascontiguousarray(H), taps_of(at, reach))


@njit(cache=True, nogil=True)
def _cell_means(grey: GreyPixels, H: Array, taps: Narrow) -> Array:
    room, means = new_room(taps.shape[1]), np.empty((len(H), taps.shape[1] // 4))
    for i in range(len(H)):
        write_means(grey, H[i], taps, room, means[i])
    return means


@njit(cache=True, nogil=True)
def write_means(grey: GreyPixels, H: Array, taps: Narrow, room: Room, means: Array) -> None:
    """Write the means of four places each of one square.

    Args:
        grey: 8-bit image.
        H: From the unit square to pixels, shape (3, 3).
        taps: From `taps_of`, shape (2, 4 k).
        room: For 4 k places at least.
        means: For the result, shape (k,).
    """
    _place(H, taps, room)
    look_up(grey, room, taps.shape[1])
    count, values = taps.shape[1] // 4, room.values
    for k in range(count):
        above, below = values[k] + values[k + count], values[k + 2 * count] + values[k + 3 * count]
        means[k] = _f32(0.25) * (above + below)


@njit(cache=True, nogil=True, error_model="numpy")
def write_square_to_quad(square_px: Array, H: Array) -> None:
    """Write what `geometry.square_to_quad` returns of one square, shapes (4, 2) and (3, 3)."""
    x, y = square_px[:, 0], square_px[:, 1]
    dx1, dy1, dx2, dy2 = x[1] - x[2], y[1] - y[2], x[3] - x[2], y[3] - y[2]
    sum_x, sum_y = x[0] - x[1] + x[2] - x[3], y[0] - y[1] + y[2] - y[3]
    determinant = dx1 * dy2 - dx2 * dy1
    g = (sum_x * dy2 - dx2 * sum_y) / determinant
    h = (dx1 * sum_y - sum_x * dy1) / determinant
    H[0, 0], H[0, 1], H[0, 2] = x[1] - x[0] + g * x[1], x[3] - x[0] + h * x[3], x[0]
    H[1, 0], H[1, 1], H[1, 2] = y[1] - y[0] + g * y[1], y[3] - y[0] + h * y[3], y[0]
    H[2, 0], H[2, 1], H[2, 2] = g, h, 1.0


@njit(cache=True, nogil=True, error_model="numpy")  # on the horizon 1 / 0 is no place
def _place(H: Array, taps: Narrow, room: Room) -> None:
    """Write the pixels of points of the unit square."""
    x_u, x_v, x_0 = _f32(H[0, 0]), _f32(H[0, 1]), _f32(H[0, 2])
    y_u, y_v, y_0 = _f32(H[1, 0]), _f32(H[1, 1]), _f32(H[1, 2])
    w_u, w_v, w_0 = _f32(H[2, 0]), _f32(H[2, 1]), _f32(H[2, 2])
    for k in range(taps.shape[1]):
        u, v = taps[0, k], taps[1, k]
        w = _f32(1) / (w_u * u + w_v * v + w_0)
        room.x[k], room.y[k] = (x_u * u + x_v * v + x_0) * w, (y_u * u + y_v * v + y_0) * w


@njit(cache=True, nogil=True)
def write_steps(
    grey: GreyPixels, square_px: Array, reach_px: float, room: Room, steps: Array
) -> None:
    """Write by how much the image is brighter just outside each side of a square than just inside.

    Args:
        grey: 8-bit image.
        square_px: Corners, clockwise, shape (4, 2).
        reach_px: How far outside and inside it is looked at.
        room: For 80 places at least.
        steps: For the result, ten places along each side, shape (40,).
    """
    for side in range(4):
        _place_beside(square_px, side, reach_px, room)
    look_up(grey, room, 2 * STEPS)
    for k in range(STEPS):
        steps[k] = room.values[k] - room.values[STEPS + k]


@njit(cache=True, nogil=True)
def _place_beside(square_px: Array, side: int, reach_px: float, room: Room) -> None:
    """Write the places outside a side, and those inside."""
    count, end = len(_ALONG), (side + 1) % 4
    start_x, start_y = square_px[side, 0], square_px[side, 1]
    along_x, along_y = square_px[end, 0] - start_x, square_px[end, 1] - start_y
    reach = reach_px / max(np.sqrt(along_x**2 + along_y**2), 1e-9)
    out_x, out_y = reach * along_y, -reach * along_x
    for k in range(count):
        x, y = start_x + _ALONG[k] * along_x, start_y + _ALONG[k] * along_y
        outside, inside = side * count + k, STEPS + side * count + k
        room.x[outside], room.y[outside] = x + out_x, y + out_y
        room.x[inside], room.y[inside] = x - out_x, y - out_y

"""Pictures of a chessboard by the thousand: the twin's, for one camera, ten times as fast.

The rays of a camera are the twin's and are found once. Each of `FINE` x `FINE` points of a pixel
sees the board's plane at one place; how much of the point a line of the board leaves dark goes
straight up over a width with the variance of the point's own area. The spread of light and the
sensor are the twin's. `test_quick_pictures` compares them with the twin's.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage
from tagmetry.markers import Chessboard
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.optics.spread import Spread
from tagmetry.twin.optics.spread_pixels import spread_pixels
from tagmetry.twin.scenes.sheet import INK, PAPER

FINE = 3


@dataclass(frozen=True, eq=False)
class QuickCamera:
    """A camera with the rays of all its points.

    Attributes:
        camera: The camera.
        slopes: x / z and y / z, shape (FINE * height + 1, FINE * width + 1, 2).
    """

    camera: Camera
    slopes: Array

    @classmethod
    def of(cls, camera: Camera) -> "QuickCamera":
        """Find the rays."""
        u = (np.arange(FINE * camera.width_px + 1) + 0.5) / FINE - 0.5
        v = (np.arange(FINE * camera.height_px + 1) + 0.5) / FINE - 0.5
        rays = Rays(camera).look(*np.meshgrid(u, v))
        return cls(camera, np.ascontiguousarray(rays[..., :2] / rays[..., 2:]))

    def light(
        self, board: Chessboard, T_camera_board: RigidTransform, blur_px: float
    ) -> FloatImage:
        """Return the light of a board on endless white paper, shape (height, width)."""
        R, t = T_camera_board.rotation.as_matrix(), np.asarray(T_camera_board.translation)
        columns, rows = board.corner_columns + 1, board.corner_rows + 1
        middle = np.array([columns, rows]) / 2
        squares = np.array([[1, 0, middle[0]], [0, -1, middle[1]], [0, 0, 1]])
        scale = np.diag([1 / board.square_m, 1 / board.square_m, 1])
        H = squares @ scale @ np.linalg.inv(np.column_stack([R[:, 0], R[:, 1], t]))
        ink = _ink(self.slopes, H, columns, rows)
        return spread_pixels(PAPER + np.float32(INK - PAPER) * ink, FINE, Spread(blur_px))


@njit(cache=True, nogil=True)
def _ink(slopes: Array, H: Array, columns: int, rows: int) -> FloatImage:
    """Return every point's share of ink."""
    height, width = slopes.shape[0] - 1, slopes.shape[1] - 1
    ink = np.zeros((height, width), np.float32)
    for i in range(height):
        for j in range(width):
            x, y = _seen(slopes[i, j], H)
            if not (-1 < x < columns + 1 and -1 < y < rows + 1):
                continue
            right_x, right_y = _seen(slopes[i, j + 1], H)
            below_x, below_y = _seen(slopes[i + 1, j], H)
            wave_x, in_x = _wave(x, np.hypot(right_x - x, below_x - x), columns)
            wave_y, in_y = _wave(y, np.hypot(right_y - y, below_y - y), rows)
            ink[i, j] = in_x * in_y * (1 + wave_x * wave_y) / 2
    return ink


@njit(cache=True, nogil=True)
def _seen(slope: Array, H: Array) -> tuple[float, float]:
    """Return where a ray meets the board, in squares from its top left."""
    x, y = slope
    depth = H[2, 0] * x + H[2, 1] * y + H[2, 2]
    if depth <= 0:
        return np.inf, np.inf
    across = H[0, 0] * x + H[0, 1] * y + H[0, 2]
    return across / depth, (H[1, 0] * x + H[1, 1] * y + H[1, 2]) / depth


@njit(cache=True, nogil=True)
def _wave(place: float, width: float, count: int) -> tuple[float, float]:
    """Return 1 in even squares and -1 in odd ones, and 1 on the board and 0 beside it."""
    line = np.rint(place)
    share = min(max((place - line) / width, -0.5), 0.5) if width > 0 else 0.0  # no rays: NaN
    sign = 1.0 if int(line) % 2 == 0 else -1.0
    if line <= 0:
        return 1.0, share + 0.5 if line == 0 else 0.0
    if line >= count:
        return 1.0 if count % 2 else -1.0, 0.5 - share if line == count else 0.0
    return sign * 2 * share, 1.0

"""Boards before made-up cameras, projected by OpenCV: an independent truth for the solver."""

from dataclasses import dataclass

import cv2
import numpy as np
from scipy.spatial.transform import Rotation

from tagmetry.calibrate.view import BoardView, round_covariances
from tagmetry.geometry import Array

COLUMNS, ROWS, SQUARE_M = 9, 6, 0.025
SIZE_M = (COLUMNS - 1) * SQUARE_M
FACING = np.diag([1.0, -1.0, -1.0])  # a board upright before the camera, its face towards it


@dataclass(frozen=True)
class Truth:
    """A camera by OpenCV's numbers."""

    K: Array
    coefficients: tuple[float, ...]
    size_px: tuple[int, int] = (1280, 960)
    fisheye: bool = False

    @property
    def intrinsics(self) -> Array:
        K = self.K
        return np.array([K[0, 0], K[1, 1], K[0, 2], K[1, 2], *self.coefficients])

    def project(self, p_camera: Array) -> Array:
        D, none = np.array(self.coefficients), np.zeros(3)
        if self.fisheye:
            points = p_camera.reshape(1, -1, 3)
            return cv2.fisheye.projectPoints(points, none, none, self.K, D)[0].reshape(-1, 2)
        points = p_camera.reshape(-1, 1, 3)
        return cv2.projectPoints(points, none, none, self.K, D)[0].reshape(-1, 2)


def truth(
    view_deg: float, coefficients: tuple[float, ...] = (0.0,) * 5, fisheye: bool = False
) -> Truth:
    """Return a camera 1280 px wide with a horizontal field of view (without its distortion)."""
    half = np.radians(view_deg / 2)
    focal_px = 640 / (half if fisheye else np.tan(half))
    K = np.array([[focal_px, 0, 635.7], [0, focal_px * 1.002, 486.1], [0, 0, 1]])
    return Truth(K, coefficients, fisheye=fisheye)


NARROW = truth(55, (0.05, -0.1, 0.001, 0.0005, 0.02))
USUAL = truth(70, (-0.28, 0.1, 0.001, -0.0005, -0.02))
WIDE = truth(120, (-0.12, 0.012, 0.0003, -0.0002, -0.0004))
FISHEYE = truth(150, (0.02, -0.01, 0.003, -0.001), fisheye=True)


def board_points() -> Array:
    """Return the inner corners of a chessboard from the top left, shape (54, 3)."""
    k = np.arange(COLUMNS * ROWS)
    x, y = k % COLUMNS - (COLUMNS - 1) / 2, (ROWS - 1) / 2 - k // COLUMNS
    return np.stack([x, y, np.zeros(len(k))], axis=1) * SQUARE_M


def seen(
    camera: Truth,
    count: int,
    rng: np.random.Generator,
    *,
    sd_px: float = 0.1,
    common_px: float = 0.0,
    bow_m: float = 0.0,
    tilt_deg: tuple[float, float] = (5.0, 45.0),
) -> list[BoardView]:
    """Return views that show the whole board.

    Args:
        camera: The truth.
        count: How many views.
        rng: Random numbers.
        sd_px: Of each corner by itself.
        common_px: Of a smooth error that the corners of a view share.
        bow_m: How far the real board's middle stands out of the flat one that the views claim.
        tilt_deg: Least and largest tilt.
    """
    p_board = board_points()
    real = p_board + np.array([0, 0, bow_m]) * (1 - (p_board[:, :1] / p_board[:, 0].max()) ** 2)
    views: list[BoardView] = []
    while len(views) < count:
        pixels = camera.project(_placed(real, camera, rng, tilt_deg))
        if not ((pixels > 2) & (pixels < np.array(camera.size_px) - 3)).all():
            continue
        u, v = (p_board[:, :2] / p_board[:, 0].max()).T
        smooth = np.stack([u * u, u * v, v * v], axis=1) @ rng.normal(0, 1, (3, 2))
        pixels = pixels + rng.normal(0, sd_px, pixels.shape) + common_px * smooth
        views.append(view_of(pixels, camera.size_px, f"view {len(views)}", sd_px=sd_px))
    return views


def view_of(
    pixels: Array, size_px: tuple[int, int], source: str = "", sd_px: float = 0.1
) -> BoardView:
    sd = np.full(len(pixels), sd_px if sd_px > 0 else 0.1)
    return BoardView(
        *size_px, np.arange(len(pixels)), board_points(), pixels, round_covariances(sd), source
    )


def _placed(
    p_board: Array, camera: Truth, rng: np.random.Generator, tilt_deg: tuple[float, float]
) -> Array:
    """Return the board's points in the camera frame, somewhere before it."""
    around, tilt = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(*tilt_deg))
    turn = Rotation.from_rotvec(tilt * np.array([np.cos(around), np.sin(around), 0]))
    turn = turn * Rotation.from_rotvec([0, 0, rng.uniform(-0.5, 0.5)])
    width, height = camera.size_px
    focal = camera.K[0, 0]
    if camera.fisheye:
        angles = rng.uniform(-0.8, 0.8, 2) * np.array([width, height]) / (2 * focal)
        aim = Rotation.from_euler("yx", angles)
        distance = SIZE_M * rng.uniform(0.8, 1.6)
        return (aim * turn).apply(p_board @ FACING) + aim.apply([0, 0, distance])
    depth = SIZE_M * focal / width * rng.uniform(1.3, 3.0)
    u, v = rng.uniform(0.1, 0.9, 2) * camera.size_px
    place = np.array([(u - camera.K[0, 2]) / focal, (v - camera.K[1, 2]) / focal, 1.0]) * depth
    p_camera = turn.apply(p_board @ FACING) + place
    return p_camera if p_camera[:, 2].min() > 0.02 else np.full_like(p_camera, np.nan)

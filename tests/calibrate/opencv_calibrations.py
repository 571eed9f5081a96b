"""Calibrations solved by OpenCV from real or made-up corners, in our own type."""

from collections.abc import Sequence
from functools import cache
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.view import BoardView, round_covariances
from tagmetry.camera import BrownLens, Camera, Lens
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard

PICTURES = Path("chessboard_opencv")
BOARD = Chessboard(9, 6, 0.03)
CAMERA = Camera(640, 480, (530.0, 531.0), (335.0, 236.0), BrownLens((-0.28, 0.07, 0.001, -0.0005)))
CRITERIA = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 100, 1e-12)


def data_folder() -> Path:
    """Return the folder of the 13 pictures; skips where it is missing."""
    import os

    root = Path(os.environ.get("TAGMETRY_DATA", Path(__file__).parents[3] / "shared" / "data"))
    if not (root / PICTURES).exists():
        pytest.skip(f"no {PICTURES} in {root}; TAGMETRY_DATA names the folder")
    return root / PICTURES


@cache
def real_views(half_window_px: int = 5) -> tuple[BoardView, ...]:
    """Return the corners of the 13 pictures as OpenCV finds and refines them.

    A half window of 0 is a third of the distance between corners.
    """
    return tuple(_real_view(path, half_window_px) for path in sorted(data_folder().glob("*.jpg")))


def _real_view(path: Path, half_window_px: int) -> BoardView:
    grey = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    found, corners = cv2.findChessboardCorners(grey, (9, 6))
    assert found
    criteria = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_COUNT, 30, 0.1)
    if half_window_px == 0:
        grid = corners.reshape(6, 9, 2)
        spacings = [np.linalg.norm(np.diff(grid, axis=axis), axis=-1).min() for axis in (0, 1)]
        half_window_px = int(min(spacings) / 3)
    corners = cv2.cornerSubPix(grey, corners, (half_window_px,) * 2, (-1, -1), criteria)
    return view_of(corners.reshape(-1, 2).astype(float), (640, 480), 0.14, path.name)


def view_of(
    corners_px: Array, size_px: tuple[int, int], sd_px: float, source: str = ""
) -> BoardView:
    """Return a view of all of the board's corners."""
    count = len(corners_px)
    points = np.arange(count)
    covariances_px2 = round_covariances(np.full(count, sd_px))
    return BoardView(*size_px, points, BOARD.corners_m, corners_px, covariances_px2, source)


def board_poses(count: int, seed: int, camera: Camera = CAMERA) -> RigidTransform:
    """Return poses in which the whole board is in the picture, near the middle, face to us."""
    rng = np.random.default_rng(seed)
    kept = []
    while len(kept) < count:
        tilt = Rotation.from_euler("xyz", rng.uniform([-35, -35, -20], [35, 35, 20]), degrees=True)
        facing = Rotation.from_euler("x", 180, degrees=True)
        place = rng.uniform([-0.25, -0.2, 0.3], [0.25, 0.2, 0.6])
        T = RigidTransform.from_components(place, tilt * facing)
        pixels = camera.project(T.apply(BOARD.corners_m))
        if camera.contains(pixels).all():
            kept.append(T)
    return RigidTransform.concatenate(kept)


def simulated_views(
    Ts: RigidTransform, sd_px: float, seed: int, camera: Camera = CAMERA
) -> tuple[BoardView, ...]:
    """Return what a camera sees of boards, with noise."""
    rng = np.random.default_rng(seed)
    exact = [camera.project(T.apply(BOARD.corners_m)) for T in Ts]
    return tuple(
        view_of(c + rng.normal(0, sd_px, c.shape), camera.size_px, sd_px, f"view {i}")
        for i, c in enumerate(exact)
    )


def solved_by_opencv(views: Sequence[BoardView], coefficients: int = 5) -> Calibration:
    """Return a calibration with OpenCV's numbers and the formula's covariance by its Jacobians."""
    flags = {0: cv2.CALIB_FIX_K1 + cv2.CALIB_FIX_K2 + cv2.CALIB_ZERO_TANGENT_DIST, 4: 0, 5: 0}
    flag = flags[coefficients] + (0 if coefficients == 5 else cv2.CALIB_FIX_K3)
    board = [view.p_board.astype(np.float32) for view in views]
    seen = [view.corners_px.astype(np.float32) for view in views]
    size = views[0].size_px
    _, K, D, rvecs, tvecs = cv2.calibrateCamera(
        board, seen, size, None, None, None, None, flag, CRITERIA
    )
    lens = BrownLens(tuple(float(d) for d in D.ravel()[:coefficients]))
    camera = Camera.from_matrix(*size, K, lens)
    turns = Rotation.from_rotvec(np.array(rvecs).reshape(-1, 3))
    Ts = RigidTransform.from_components(np.array(tvecs).reshape(-1, 3), turns)
    return calibration_of(camera, views, Ts)


def calibration_of(camera: Camera, views: Sequence[BoardView], Ts: RigidTransform) -> Calibration:
    """Return a calibration at given numbers, both of its covariances the formula's."""
    residuals = tuple(
        view.corners_px - camera.project(Ts[i].apply(view.p_board)) for i, view in enumerate(views)
    )
    covariance = opencv_covariance(camera.matrix, camera.lens, views, Ts, residuals)
    return Calibration(
        Camera(*camera.size_px, camera.focal_px, camera.center_px, camera.lens, covariance),
        covariance,
        tuple(views),
        Ts,
        residuals,
        tuple(np.ones(len(view.points), bool) for view in views),
        BOARD.corners_m,
        shape_released=False,
    )


def opencv_covariance(
    K: Array, lens: Lens, views: Sequence[BoardView], Ts: RigidTransform, residuals: Sequence[Array]
) -> Array:
    """Return s^2 (J^T J)^-1 of the intrinsics from cv2.projectPoints' Jacobians, all at once."""
    count = 4 + len(lens.coefficients)
    J = np.zeros((sum(2 * len(v.points) for v in views), count + 6 * len(views)))
    row = 0
    for i, view in enumerate(views):
        rvec, tvec = Ts[i].rotation.as_rotvec(), Ts[i].translation
        D = np.pad(lens.coefficients, (0, 5 - len(lens.coefficients)))
        _, jacobian = cv2.projectPoints(view.p_board, rvec, tvec, K, D)
        rows = slice(row, row + 2 * len(view.points))
        J[rows, :count] = jacobian[:, 6 : 6 + count]
        J[rows, count + 6 * i : count + 6 * i + 6] = jacobian[:, :6]
        row = rows.stop
    scale = np.linalg.norm(J, axis=0)
    inverse = np.linalg.inv((J / scale).T @ (J / scale)) / np.outer(scale, scale)
    s2 = sum((r**2).sum() for r in residuals) / (len(J) - J.shape[1])
    return s2 * inverse[:count, :count]

"""The webcam of seed 003 calibrated, by tagmetry and as the paper's program does it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import cv2
import numpy as np
from cv2.typing import MatLike

from tagmetry.calibrate import BoardView, calibrate, find_board
from tagmetry.camera import BrownLens, Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.rigs.webcam import (
    BOARD,
    CAMERA,
    VIEWS,
    TutorialPose,
    board_picture,
    board_poses,
    to_tutorial,
)

Method = Literal["tagmetry", "paper"]
METHODS: tuple[Method, ...] = ("tagmetry", "paper")

_PATTERN = (BOARD.corner_columns, BOARD.corner_rows)
_WINDOW = (11, 11)
_ENOUGH = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 100, 0.001)


@dataclass(frozen=True)
class Case:
    """One calibration.

    Attributes:
        method: Whose.
        repeat: Which of its repeats, each with other noise.
    """

    method: Method
    repeat: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return both methods, each as often as it is repeated."""
    repeats = range(1 if quick else 8)
    return tuple(Case(method, repeat) for repeat in repeats for method in METHODS)


@dataclass(frozen=True, eq=False)
class SolvedWebcam:
    """A calibration of the webcam.

    Attributes:
        camera: With its covariance where the method gives one.
        rms_px: Root of the mean squared 2-D error.
        tutorial_error_px: Mean over the views of the norm of all errors by the number of corners.
        views: Which of the 35 views were used, 0 to 34.
        poses: Of the board in those views.
    """

    camera: Camera
    rms_px: float
    tutorial_error_px: float
    views: tuple[int, ...]
    poses: tuple[TutorialPose, ...]


def solved_webcam(method: Method, rng: np.random.Generator) -> SolvedWebcam:
    """Return the webcam as a method finds it in 35 pictures of the board."""
    pictures = [board_picture(T_camera_board, rng) for T_camera_board in board_poses()]
    return _by_tagmetry(pictures) if method == "tagmetry" else _by_opencv(pictures)


def _by_tagmetry(pictures: Sequence[AnyPixels]) -> SolvedWebcam:
    found = [find_board(pixels, BOARD, source=str(n)) for n, pixels in enumerate(pictures)]
    solved = calibrate([one for one in found if isinstance(one, BoardView)], "brown5")
    return SolvedWebcam(
        solved.camera,
        solved.rms_px,
        solved.tutorial_error_px,
        tuple(int(view.source) for view in solved.views),
        tuple(to_tutorial(T_camera_board) for T_camera_board in solved.Ts_camera_board),
    )


def _by_opencv(pictures: Sequence[AnyPixels]) -> SolvedWebcam:
    """Return what OpenCV's tutorial gives: 11x11 windows, 100 iterations or 0.001 px."""
    columns, rows = np.meshgrid(np.arange(_PATTERN[0]), np.arange(_PATTERN[1]))
    squares = np.stack([columns, rows, 0 * rows], axis=-1).reshape(-1, 3).astype(np.float32)
    found = {n: corners for n, one in enumerate(pictures) if len(corners := _corners(one))}
    if len(found) < VIEWS / 2:
        raise InputError(f"OpenCV finds the board in {len(found)} of {VIEWS} pictures only")
    rms_px, K, coefficients, turns, places = cv2.calibrateCamera(
        [squares] * len(found),
        [one.astype(np.float32) for one in found.values()],
        CAMERA.size_px,
        np.eye(3),
        np.zeros(5),
    )
    lens = BrownLens(tuple(np.ravel(coefficients).tolist()))
    errors = [
        corners - cv2.projectPoints(squares, turn, place, K, coefficients)[0]
        for corners, turn, place in zip(found.values(), turns, places, strict=True)
    ]
    return SolvedWebcam(
        Camera.from_matrix(*CAMERA.size_px, np.asarray(K, dtype=np.float64), lens),
        float(rms_px),
        float(np.mean([np.linalg.norm(error) / len(error) for error in errors])),
        tuple(found),
        tuple(_tutorial_pose(*pose) for pose in zip(turns, places, strict=True)),
    )


def _corners(pixels: AnyPixels) -> Array:
    """Return the corners of a picture, (n, 1, 2), none where OpenCV sees no board."""
    is_seen, corners = cv2.findChessboardCorners(pixels, _PATTERN)
    if not is_seen:
        return np.zeros((0, 1, 2))
    refined = cv2.cornerSubPix(pixels, corners, _WINDOW, (-1, -1), _ENOUGH)
    return np.asarray(refined, dtype=np.float64).reshape(-1, 1, 2)


def _tutorial_pose(turn: MatLike, place: MatLike) -> TutorialPose:
    parts = (np.ravel(np.asarray(one, dtype=np.float64)) for one in (turn, place))
    return TutorialPose(*parts)

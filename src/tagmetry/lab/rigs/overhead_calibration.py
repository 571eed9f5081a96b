"""The overhead camera calibrated from rendered ChArUco boards, and its place over the floor.

"tagmetry" is this software; "paper" is what seed 001's section 3.2 does with OpenCV.
"""

from collections.abc import Sequence
from typing import Literal

import cv2
import numpy as np

from tagmetry.arena import OverheadView, lay_floor
from tagmetry.calibrate import BoardView, calibrate, find_board
from tagmetry.camera import BrownLens, Camera
from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, UncertainTransform
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.rigs.overhead import (
    BOARD,
    CAMERA,
    FAMILY,
    FLOOR_IDS,
    FLOOR_PLACES,
    FLOOR_SIZE_M,
    floor_thing,
    photographed,
)
from tagmetry.markers.bodies import MarkerKey

Method = Literal["tagmetry", "paper"]
METHODS: tuple[Method, ...] = ("tagmetry", "paper")

_LEAST_CORNERS = 8


def calibrated(method: Method, pictures: Sequence[AnyPixels]) -> tuple[Camera, float]:
    """Return the camera of pictures of the board, and the rms of the errors in pixels."""
    return _by_tagmetry(pictures) if method == "tagmetry" else _by_opencv(pictures)


def view_over_floor(camera: Camera, rng: np.random.Generator) -> OverheadView:
    """Return the camera's place as one picture of five floor markers tells it.

    The world's origin is the first one's centre. Where the others lie is not told, but the
    direction of one of them, so that places in this world can be compared with the true ones.
    """
    seen = Detector([FAMILY]).detect(photographed([floor_thing()], rng), camera)
    own = [one for one in seen if one.id in FLOOR_IDS]
    keys = [MarkerKey(FAMILY, number) for number in FLOOR_IDS[:2]]
    laid = lay_floor(own, [FLOOR_SIZE_M] * len(own), camera, *keys)
    return _turned(laid.view)


def _turned(view: OverheadView) -> OverheadView:
    """Return the view in the rig's world, whose x axis is not that toward the second marker."""
    x_m, y_m, _ = FLOOR_PLACES[1]
    turn = Rotation.from_euler("z", np.arctan2(y_m, x_m))
    to_rig = UncertainTransform.exact(RigidTransform.from_rotation(turn))
    moved = to_rig @ UncertainTransform(view.T_world_camera, view.covariance)
    return OverheadView(view.camera, moved.T_a_b, moved.covariance)


def _by_tagmetry(pictures: Sequence[AnyPixels]) -> tuple[Camera, float]:
    found = [find_board(pixels, BOARD, source=str(n)) for n, pixels in enumerate(pictures)]
    solved = calibrate([one for one in found if isinstance(one, BoardView)], "brown5")
    return solved.camera, solved.rms_px


def _by_opencv(pictures: Sequence[AnyPixels]) -> tuple[Camera, float]:
    """Return what OpenCV's ChArUco board gives with its own defaults."""
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_5X5_250)
    size = (BOARD.columns, BOARD.rows)
    board = cv2.aruco.CharucoBoard(size, BOARD.square_m, BOARD.size_m, dictionary)
    detector = cv2.aruco.CharucoDetector(board)
    points, pixels = [], []
    for picture in pictures:
        corners, ids, _, _ = detector.detectBoard(picture)
        if np.size(ids) >= _LEAST_CORNERS:
            on_board, in_image = board.matchImagePoints(list(corners), ids)
            points.append(on_board)
            pixels.append(in_image)
    if len(points) < 3:
        raise InputError(f"OpenCV finds the board in {len(points)} of {len(pictures)} pictures")
    rms_px, K, coefficients, _, _ = cv2.calibrateCamera(
        points, pixels, CAMERA.size_px, np.eye(3), np.zeros(5)
    )
    lens = BrownLens(tuple(np.ravel(coefficients).tolist()))
    found = Camera.from_matrix(*CAMERA.size_px, np.asarray(K, dtype=np.float64), lens)
    return found, float(rms_px)

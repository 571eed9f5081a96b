"""The same from pictures: how often the truth lies in the stated 95 % ellipsoid.

    python tests/calibrate/rendered_study.py [runs] [camera ...]

photographs a chessboard with 20 cameras of 55 to 120 degrees, 640x480 as in seed 003: 35 new views,
each with its own noise, in every run. It finds the boards, solves, looks at the corners again with
that camera, solves again, and compares with the camera that rendered; OpenCV solves from the same
corners and from its own, and lensboy where it is installed. The pictures are the twin's, which
shares no code with the finder or the solver. Names of cameras after the runs leave out the others.
"""

import sys
from collections.abc import Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from io import StringIO
from itertools import islice

import cv2
import numpy as np
from coverage_study import CAMERAS, pose_of
from quick_pictures import QuickCamera
from scipy import stats
from seen_boards import COLUMNS, ROWS, SQUARE_M, Truth, seen

from tagmetry.calibrate import (
    BoardFindings,
    BoardView,
    LensName,
    calibrate,
    explain_board,
    look_again,
)
from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.geometry import Array, RigidTransform, mahalanobis_squared
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard
from tagmetry.twin.optics import Sensor, developed

VIEWS, TILT_DEG = 35, (5.0, 55.0)
LEAST_SQUARE_PX, BLUR_PX = 10.0, 0.8
BOARD = Chessboard(COLUMNS, ROWS, SQUARE_M)
SENSOR = Sensor(full_well_e=6000, read_noise_e=15)
PINHOLE = cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST
FLAGS = {0: PINHOLE, 4: cv2.CALIB_FIX_K3, 5: 0, 8: cv2.CALIB_RATIONAL_MODEL}
SUB_PIXEL = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_MAX_ITER, 50, 1e-4)


def smaller(one: Truth) -> Truth:
    """Return the camera with half as many pixels along each side."""
    K = one.K / np.array([[2.0], [2.0], [1.0]])
    K[:2, 2] -= 0.25
    width_px, height_px = one.size_px
    return replace(one, K=K, size_px=(width_px // 2, height_px // 2))


STUDIED = {name: (smaller(one), lens) for name, (one, lens) in CAMERAS.items()}


@dataclass(frozen=True)
class Run:
    """One calibration beside the truth.

    Attributes:
        distance2: Squared Mahalanobis distance of the truth by our covariance.
        unknowns: How many numbers the camera has; the distance's mean, if the covariance is right.
        focal: Errors of fx in percent: ours, OpenCV's from our corners and from its own, lensboy's.
        within: Whether fx is within 1.96 stated deviations, ours and OpenCV's from its corners.
        corner_px: Root mean square errors of the corners, ours and OpenCV's.
    """

    distance2: float
    unknowns: int
    focal: tuple[float, ...]
    within: tuple[float, float]
    corner_px: tuple[float, ...]

    @property
    def inside(self) -> bool:
        """Whether the truth lies in the stated 95 % ellipsoid."""
        return bool(self.distance2 < stats.chi2.ppf(0.95, self.unknowns))


@dataclass(frozen=True, eq=False)
class Picture:
    """A picture, where its corners truly are, and where the board is."""

    pixels: GreyPixels
    corners_px: Array
    T_camera_board: RigidTransform


def camera_of(one: Truth) -> Camera:
    """Return the camera that the twin renders with."""
    lens = FisheyeLens(one.coefficients) if one.fisheye else BrownLens(one.coefficients)
    return Camera.from_matrix(*one.size_px, one.K, lens)


def pictures(one: Truth, rng: np.random.Generator) -> Iterator[Picture]:
    """Give pictures that show the whole board, for ever."""
    quick = QuickCamera.of(camera_of(one))
    while True:
        (view,) = seen(one, 1, rng, sd_px=1e-6, tilt_deg=TILT_DEG)
        R, t = pose_of(one, view)
        T = RigidTransform.from_components(t, Rotation.from_matrix(R))
        rim_px, corners_px = (
            one.project(T.apply(places)) for places in (_rim_m(), BOARD.corners_m)
        )
        if _is_inside(rim_px, one) and _thinnest_px(corners_px) > LEAST_SQUARE_PX:
            light = quick.light(BOARD, T, BLUR_PX)
            yield Picture(developed(light, SENSOR, rng), corners_px, T)


def _thinnest_px(corners_px: Array) -> float:
    """Return the least distance between opposite sides of a square."""
    grid = corners_px.reshape(ROWS, COLUMNS, 2)
    along, down = np.diff(grid, axis=1)[1:], np.diff(grid, axis=0)[:, 1:]
    area = along[..., 0] * down[..., 1] - along[..., 1] * down[..., 0]
    longest = np.maximum(np.linalg.norm(along, axis=-1), np.linalg.norm(down, axis=-1))
    return float((area / longest).min())


def _rim_m() -> Array:
    """Return points around the outer squares of the board."""
    half = np.array([COLUMNS + 1, ROWS + 1]) * SQUARE_M / 2
    around = np.array([[-1, -1], [0, -1], [1, -1], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0]])
    return np.pad(around * half, ((0, 0), (0, 1)))


def _is_inside(places_px: Array, one: Truth) -> bool:
    return bool(((places_px > 0) & (places_px < np.array(one.size_px) - 1)).all())


def run(one: Truth, lens: LensName, shown: Iterator[Picture]) -> Run:
    """Return what comes out of views of one camera."""
    looked = list(islice(_found(shown), VIEWS))
    views, camera = _ours(lens, [findings for _, findings in looked])
    found = [(picture, view) for (picture, _), view in zip(looked, views, strict=True)]
    theirs = [replace(v, corners_px=_opencv_corners_px(p.pixels, v)) for p, v in found]
    error, covariance = _numbers(camera) - one.intrinsics, np.asarray(camera.covariance)
    same, _ = _opencv_focal_px(views, one)
    own, sd = _opencv_focal_px(theirs, one)
    focal_px = one.intrinsics[0]
    focal = np.array([error[0], *(np.array([same, own, _lensboy_focal_px(views, one)]) - focal_px)])
    return Run(
        mahalanobis_squared(error, covariance),
        len(error),
        tuple(float(e) for e in 100 * focal / focal_px),
        (abs(focal[0]) < 1.96 * np.sqrt(covariance[0, 0]), abs(focal[2]) < 1.96 * sd),
        tuple(_rms_px(found, each) for each in (views, theirs)),
    )


def _found(shown: Iterator[Picture]) -> Iterator[tuple[Picture, BoardFindings]]:
    """Give the pictures in which the board is found."""
    for picture in shown:
        findings = explain_board(picture.pixels, BOARD)
        if isinstance(findings.result, BoardView):
            yield picture, findings


def _ours(lens: LensName, looked: list[BoardFindings]) -> tuple[tuple[BoardView, ...], Camera]:
    """Return the views after the second look, and the camera."""
    first = calibrate([findings.result for findings in looked], lens)
    views = look_again(first, looked, BOARD)
    return views, calibrate(views, lens).camera


def _numbers(camera: Camera) -> Array:
    return np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients])


def _opencv_corners_px(pixels: GreyPixels, view: BoardView) -> Array:
    """Return OpenCV's refinement of the corners, in its usual window."""
    guesses = view.corners_px.astype(np.float32).reshape(-1, 1, 2)
    found = cv2.cornerSubPix(pixels, guesses, (5, 5), (-1, -1), SUB_PIXEL)
    return np.asarray(found, np.float64).reshape(-1, 2)


def _opencv_focal_px(views: list[BoardView], one: Truth) -> tuple[float, float]:
    """Return OpenCV's focal length and its stated deviation, NaN where it states none."""
    kind = np.float64 if one.fisheye else np.float32
    points = [view.p_board.astype(kind)[None] for view in views]
    corners = [view.corners_px.astype(kind)[None] for view in views]
    if one.fisheye:
        flags = cv2.CALIB_RECOMPUTE_EXTRINSIC | cv2.CALIB_FIX_SKEW
        solve = cv2.fisheye.calibrate
        return float(
            solve(points, corners, one.size_px, None, None, None, None, flags)[1][0, 0]
        ), np.nan
    flags = FLAGS[len(one.coefficients)]
    solved = cv2.calibrateCameraExtended(points, corners, one.size_px, None, None, flags=flags)
    return float(solved[1][0, 0]), float(solved[5][0, 0])


def _lensboy_focal_px(views: list[BoardView], one: Truth) -> float:
    """Return lensboy's focal length, NaN where it is not installed or has no such lens."""
    try:
        import lensboy
    except ImportError:
        return np.nan
    if one.fisheye:
        return np.nan
    width_px, height_px = one.size_px
    free = np.arange(14) < len(one.coefficients)
    kind = lensboy.OpenCVConfig(height_px, width_px, included_distortion_coefficients=free)
    frames = [lensboy.Frame(view.points, view.corners_px) for view in views]
    with redirect_stdout(StringIO()):  # it prints
        solved = lensboy.calibrate_camera(BOARD.corners_m, frames, kind, estimate_target_warp=False)
    return float(solved.camera_model.fx)


def _rms_px(found: list[tuple[Picture, BoardView]], views: list[BoardView]) -> float:
    """Return the root mean square error of corners along an axis."""
    errors_px = [
        view.corners_px - picture.corners_px[view.points]
        for (picture, _), view in zip(found, views, strict=True)
    ]
    return float(np.sqrt((np.concatenate(errors_px) ** 2).mean()))


HEAD = """\
                                focal error rms %                   fx in 1.96 sd   corners px
camera            inside d^2/n   ours   OpenCV its corners lensboy   ours   OpenCV   ours OpenCV"""


def line(name: str, runs: list[Run]) -> str:
    """Return a line of the table; NaN where OpenCV states nothing or lensboy is missing."""
    inside = np.mean([one.inside for one in runs])
    spread = np.mean([one.distance2 / one.unknowns for one in runs])
    focal = np.sqrt(np.mean(np.square([one.focal for one in runs]), axis=0))
    within = np.mean([one.within for one in runs], axis=0)
    corner_px = np.mean([one.corner_px for one in runs], axis=0)
    numbers = " ".join(f"{number:8.4f}" for number in (*focal, *within, *corner_px))
    return f"{name:16s} {inside:7.3f} {spread:5.2f} {numbers}"


def main(runs: int = 10, *names: str) -> None:
    """Print a line for each camera, and the shares over all."""
    print(HEAD)
    everything: list[Run] = []
    for number, (name, (one, lens)) in enumerate(STUDIED.items()):
        if names and name not in names:
            continue
        shown = pictures(one, np.random.default_rng([2003, number]))
        own = [run(one, lens, shown) for _ in range(runs)]
        everything += own
        print(line(name, own), flush=True)
    print(line("all", everything))
    print(f"worst focal error {max(abs(one.focal[0]) for one in everything):.4f} %")


if __name__ == "__main__":
    main(*(int(text) for text in sys.argv[1:2]), *sys.argv[2:])

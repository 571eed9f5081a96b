"""The same from pictures: how often the truth lies in the stated 95 % ellipsoid.

    python tests/calibrate/rendered_study.py [runs] [processes]

renders 35 views of a chessboard for each of the 20 cameras of `coverage_study`, develops each with
new noise in every run, finds the board, solves, and compares with the camera that rendered. OpenCV
solves from the same corners. The pictures are the twin's, which shares no code with the solver.
"""

import sys
from functools import partial
from multiprocessing import Pool

import cv2
import numpy as np
from coverage_study import CAMERAS, pose_of
from scipy import stats
from seen_boards import COLUMNS, ROWS, SQUARE_M, Truth, seen

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.covariance import covariances
from tagmetry.calibrate.fit import refit
from tagmetry.calibrate.freedom import Wanted
from tagmetry.calibrate.sightings import gather
from tagmetry.calibrate.targets import find_board
from tagmetry.calibrate.view import BoardView
from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.geometry import RigidTransform, mahalanobis_squared
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard
from tagmetry.twin import Optics, Scene, Shot, exposed
from tagmetry.twin.optics import Sensor, developed
from tagmetry.twin.scenes import Still, board_thing

BOARD = Chessboard(COLUMNS, ROWS, SQUARE_M)
PINHOLE = cv2.CALIB_FIX_K1 | cv2.CALIB_FIX_K2 | cv2.CALIB_FIX_K3 | cv2.CALIB_ZERO_TANGENT_DIST
FLAGS = {0: PINHOLE, 4: cv2.CALIB_FIX_K3, 5: 0}
SENSOR = Sensor(full_well_e=6000, read_noise_e=15)


def camera_of(one: Truth) -> Camera:
    """Return the camera that the twin renders with."""
    lens = FisheyeLens(one.coefficients) if one.fisheye else BrownLens(one.coefficients)
    return Camera.from_matrix(*one.size_px, one.K, lens)


def lights(one: Truth, count: int, rng: np.random.Generator) -> list[np.ndarray]:
    """Return the light of views on the sensor, without noise."""
    poses = [pose_of(one, view) for view in seen(one, count, rng, sd_px=0.01)]
    places = [RigidTransform.from_components(t, Rotation.from_matrix(R)) for R, t in poses]
    shot = Shot(camera_of(one), Still(RigidTransform.identity()), optics=Optics(0.7))
    return [exposed(Scene((board_thing(BOARD, Still(T)),)), shot) for T in places]


def opencv_focal_px(views: list[BoardView], one: Truth) -> float:
    """Return OpenCV's focal length from the same corners."""
    kind = np.float64 if one.fisheye else np.float32
    points = [view.p_board.astype(kind)[None] for view in views]
    corners = [view.corners_px.astype(kind)[None] for view in views]
    if one.fisheye:
        flags = cv2.CALIB_RECOMPUTE_EXTRINSIC | cv2.CALIB_FIX_SKEW
        solve = cv2.fisheye.calibrate
        return float(solve(points, corners, one.size_px, None, None, None, None, flags)[1][0, 0])
    flags = FLAGS[len(one.coefficients)]
    solved = cv2.calibrateCamera(points, corners, one.size_px, None, None, flags=flags)
    return float(solved[1][0, 0])


def study(name: str, runs: int) -> list[tuple[float, float, float, int]]:
    """Return for each run: inside, our focal error and OpenCV's in percent, views found."""
    one, lens = CAMERAS[name]
    rng = np.random.default_rng(7)
    shown = lights(one, 35, rng)
    limit = stats.chi2.ppf(0.95, len(one.intrinsics))
    rows = []
    for _ in range(runs):
        pictures = [developed(light, SENSOR, rng) for light in shown]
        views = [view for p in pictures if isinstance(view := find_board(p, BOARD), BoardView)]
        poses = [pose_of(one, view) for view in views]
        R, t = (np.array(part) for part in zip(*poses, strict=True))
        sightings, wanted = gather(views), Wanted(lens)
        start = Bundle(wanted.kind, one.intrinsics, R, t, sightings.p_board)
        fit = refit(start, sightings, wanted, robust=True)
        error = fit.bundle.intrinsics - one.intrinsics
        covariance = covariances(fit.bundle, fit.seen, fit.freedom).by_view
        f = one.intrinsics[0]
        peer = opencv_focal_px(views, one)
        inside = mahalanobis_squared(error, covariance) < limit
        rows.append((float(inside), 100 * error[0] / f, 100 * (peer - f) / f, len(views)))
    return rows


def main(runs: int = 10, processes: int = 2) -> None:
    """Print a line for each camera, and the share over all."""
    print("camera          inside  views  focal error rms %: ours, OpenCV", flush=True)
    everything = []
    with Pool(processes) as pool:
        for name, rows in zip(CAMERAS, pool.imap(partial(study, runs=runs), CAMERAS), strict=True):
            all_rows = np.array(rows)
            everything.append(all_rows)
            inside, views = all_rows[:, 0].mean(), all_rows[:, 3].mean()
            ours, peer = np.sqrt((all_rows[:, 1:3] ** 2).mean(axis=0))
            print(f"{name:16s} {inside:5.2f}  {views:5.1f}  {ours:8.4f} {peer:8.4f}", flush=True)
    total = np.concatenate(everything)
    print(f"all: {total[:, 0].mean():.3f} inside of {len(total)} runs")
    print(f"worst focal error {np.abs(total[:, 1]).max():.4f} %")


if __name__ == "__main__":
    main(*(int(text) for text in sys.argv[1:]))

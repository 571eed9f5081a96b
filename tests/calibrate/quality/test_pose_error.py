"""The calibration's error carried to a marker's pose: as many drawn cameras give it."""

from dataclasses import replace

import cv2
import numpy as np
import pytest
from opencv_calibrations import (
    CAMERA,
    board_poses,
    calibration_of,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.quality import Place, pose_error
from tagmetry.calibrate.result import Calibration
from tagmetry.errors import InputError
from tagmetry.geometry import Array, mahalanobis_squared

SIZE_M = 0.05
CORNERS_M = SIZE_M / 2 * np.array([[-1, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]], float)
POSES = board_poses(12, seed=8)


def calibration() -> Calibration:
    return calibration_of(CAMERA, simulated_views(POSES, 0.1, seed=9), POSES)


def posed_by_opencv(intrinsics: Array, corners_px: Array, start: tuple) -> Array:
    """Return the change (translation, rotation vector on the left) from a start."""
    fx, fy, cx, cy = intrinsics[:4]
    K, D = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]), np.append(intrinsics[4:], 0.0)
    rvec, tvec = (v.reshape(3, 1).copy() for v in start)
    criteria = (cv2.TERM_CRITERIA_EPS + cv2.TERM_CRITERIA_COUNT, 50, 1e-14)
    rvec, tvec = cv2.solvePnPRefineLM(CORNERS_M, corners_px, K, D, rvec, tvec, criteria)
    turn = cv2.Rodrigues(rvec)[0] @ cv2.Rodrigues(start[0])[0].T
    return np.concatenate([tvec.ravel() - start[1], cv2.Rodrigues(turn)[0].ravel()])


@pytest.mark.parametrize(
    "place",
    [Place((320.0, 240.0), 0.6, 35.0, 0.0), Place((110.0, 90.0), 0.5, 45.0, 90.0)],
    ids=["middle", "corner"],
)
@pytest.mark.parametrize("corner_sd_px", [0.0, 0.1])
def test_spread_of_poses_is_what_is_predicted(place: Place, corner_sd_px: float) -> None:
    camera = calibration().camera
    found = pose_error(calibration(), SIZE_M, [place], corner_sd_px or 1.0)[0]
    T = found.T_camera_marker
    exact = camera.project(T.apply(CORNERS_M))
    truth = np.concatenate([camera.focal_px, camera.center_px, camera.lens.coefficients])
    rng = np.random.default_rng(0)
    start = (T.rotation.as_rotvec(), np.asarray(T.translation))
    off = [
        posed_by_opencv(
            rng.multivariate_normal(truth, camera.covariance),
            exact + rng.normal(0, corner_sd_px, (4, 2)),
            start,
        )
        for _ in range(300)
    ]
    covariance = found.by_calibration + (found.by_corners if corner_sd_px else 0)
    ratio = np.std(off, axis=0) / np.sqrt(np.diag(covariance))
    np.testing.assert_allclose(ratio, 1, atol=0.17)
    if corner_sd_px:  # without, two directions are all but certain
        assert mahalanobis_squared(np.array(off), covariance).mean() == pytest.approx(6, rel=0.15)


def test_position_follows_the_principal_point() -> None:
    """With cx uncertain alone, a marker ahead is off sideways by distance / focal length."""
    alone = np.zeros((8, 8))
    alone[2, 2] = 2.0**2
    camera = replace(CAMERA, covariance=alone)
    found = pose_error(replace(calibration(), camera=camera), SIZE_M, [Place((335, 236), 1.0, 0.0)])
    np.testing.assert_allclose(found[0].position_mm[0], 2 / 530 * 1000, rtol=1e-3)
    assert found[0].worst_mm == pytest.approx(2 / 530 * 1000, rel=1e-2)


def test_distance_follows_the_focal_length() -> None:
    alone = np.zeros((8, 8))
    alone[:2, :2] = 5.3**2
    camera = replace(CAMERA, covariance=alone)
    found = pose_error(replace(calibration(), camera=camera), SIZE_M, [Place((335, 236), 0.8, 0.0)])
    assert found[0].distance_mm == pytest.approx(8.0, rel=5e-3)


def test_corners_add_to_the_calibration() -> None:
    found = pose_error(calibration(), SIZE_M, [Place((320, 240), 0.6)])[0]
    assert found.worst_with_corners_mm > found.worst_mm
    assert found.worst_with_corners_deg > found.worst_deg


def test_real_pictures_are_worse_at_the_corner_they_never_show() -> None:
    places = [Place((320, 240), 0.5), Place((40, 40), 0.5)]
    middle, corner = pose_error(solved_by_opencv(real_views(), 5), SIZE_M, places)
    assert middle.worst_mm < 1
    assert corner.worst_mm > 5 * middle.worst_mm


@pytest.mark.parametrize(
    ("size_m", "place", "message"),
    [
        (0.0, Place((320, 240), 0.5), "size_m must be positive, got 0.0"),
        (0.05, Place((320, 240), np.nan), "distance_m must be positive, got nan"),
        (0.05, Place((320, 240), 0.02, 80.0), "does not show all of a marker's face"),
        (0.05, Place((320, 240), 0.5, 95.0), "does not show all of a marker's face"),
    ],
)
def test_refuses(size_m: float, place: Place, message: str) -> None:
    with pytest.raises(InputError, match=message):
        pose_error(calibration(), size_m, [place])

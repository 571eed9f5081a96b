"""What is known after views: laws of information, and OpenCV's own covariance."""

from dataclasses import replace

import numpy as np
import pytest
from opencv_calibrations import (
    BOARD,
    CAMERA,
    board_poses,
    calibration_of,
    opencv_covariance,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.guidance import HoldingLimits, Knowledge, describe, next_view, rough_camera
from tagmetry.calibrate.guidance.candidates import candidates
from tagmetry.calibrate.quality import Place
from tagmetry.calibrate.quality.projection import at_pixels, image_grid, motion_of_views
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.markers import CharucoBoard

POSES = board_poses(12, seed=4)
VIEWS = simulated_views(POSES, 0.1, seed=5)


def known() -> Knowledge:
    return Knowledge.of_calibration(calibration_of(CAMERA, VIEWS[:6], POSES[:6]))


def test_more_views_never_raise_the_uncertainty() -> None:
    for start in (known(), Knowledge.rough((640, 480))):
        worst = [start.with_views(VIEWS[6 : 6 + n]).worst_px for n in range(7)]
        assert (np.diff(worst) <= 1e-9).all()
        assert worst[-1] < worst[0]


def test_order_of_views_does_not_matter() -> None:
    forth = known().with_views(VIEWS[6:])
    back = known().with_views(VIEWS[:5:-1])
    np.testing.assert_allclose(forth.worst_px, back.worst_px, rtol=1e-7)


def test_no_views_tell_nothing() -> None:
    assert known().with_views(()) is not None
    assert known().with_views(()).worst_px == known().worst_px


def test_after_more_views_the_covariance_is_that_of_opencv() -> None:
    start = known()
    calibration = calibration_of(CAMERA, VIEWS, POSES)
    basis = start.freedom.basis
    found = basis @ np.linalg.inv(start.with_views(VIEWS[6:]).information) @ basis.T
    expected = opencv_covariance(CAMERA.matrix, CAMERA.lens, VIEWS, POSES, calibration.residuals_px)
    np.testing.assert_allclose(np.diag(found), np.diag(expected), rtol=0.1)


def test_deviations_that_were_claimed_wrong_do_no_harm() -> None:
    """Ten times the true sd of every corner: what the errors show counts, not what was claimed."""
    claimed = [replace(view, covariances_px2=100 * view.covariances_px2) for view in VIEWS]
    start = Knowledge.of_calibration(calibration_of(CAMERA, claimed[:6], POSES[:6]))
    np.testing.assert_allclose(start.worst_px, known().worst_px, rtol=1e-6)
    after = start.with_views(claimed[6:]).worst_px
    np.testing.assert_allclose(after, known().with_views(VIEWS[6:]).worst_px, rtol=1e-6)


def test_a_rough_camera_holds_for_common_ones() -> None:
    rough = rough_camera((1280, 720))
    width, height = rough.size_px
    sd = np.sqrt(np.diag(rough.covariance))
    for degrees in (45, 75):
        focal = width / 2 / np.tan(np.radians(degrees) / 2)
        assert abs(rough.focal_px[0] - focal) < 2 * sd[0]
    assert rough.center_px == ((width - 1) / 2, (height - 1) / 2)


def test_next_view_is_wholly_in_the_picture_and_matches_its_outline() -> None:
    found = next_view(known(), BOARD)
    pixels = CAMERA.project(found.T_camera_board.apply(BOARD.corners_m))
    assert ((pixels > 7) & (pixels < [632, 472])).all()
    x, y = BOARD.width_m / 2, BOARD.height_m / 2
    edge = CAMERA.project(found.T_camera_board.apply([[-x, y, 0], [x, y, 0], [x, -y, 0]]))
    np.testing.assert_allclose(found.outline_px[[0, 12, 24]], edge, atol=1e-9)


def test_next_view_does_what_it_promises_by_opencv() -> None:
    calibration = solved_by_opencv(real_views(), 5)
    found = next_view(Knowledge.of_calibration(calibration), BOARD)
    added = simulated_views(
        RigidTransform.concatenate([found.T_camera_board]), 0.14, 1, calibration.camera
    )
    poses = RigidTransform.concatenate([calibration.Ts_camera_board, found.T_camera_board])
    residuals = [*calibration.residuals_px, np.zeros((54, 2))]
    covariance = opencv_covariance(
        calibration.camera.matrix,
        calibration.camera.lens,
        [*real_views(), *added],
        poses,
        residuals,
    )
    grid = image_grid(calibration.camera, 9, 7)
    carried = at_pixels(motion_of_views(calibration), grid)
    of_grid = carried @ covariance @ np.swapaxes(carried, -1, -2)
    worst = np.sqrt(np.linalg.eigvalsh(of_grid).max())
    assert worst == pytest.approx(found.expected_px, rel=0.1)
    assert found.expected_px < 0.15 * found.now_px


def test_no_other_place_is_better() -> None:
    start = known()
    tried = candidates(start, BOARD, HoldingLimits())
    expected = start.worst_with_px(start.of_views(tried.bundle, tried.seen))
    assert next_view(start, BOARD).expected_px == expected.min()
    assert expected.max() > 1.1 * expected.min()


def test_a_board_of_markers_may_be_seen_in_part() -> None:
    charuco = CharucoBoard(10, 7, 0.03, 0.022)
    start = known()
    whole = candidates(start, BOARD, HoldingLimits())
    part = candidates(start, charuco, HoldingLimits())
    assert (whole.seen.used.mean(axis=1) == 1).all()
    assert (part.seen.used.mean(axis=1) < 1).any()
    assert (part.seen.used.mean(axis=1) >= 0.5).all()


def test_stays_within_limits_and_away_from_views_taken() -> None:
    limits = HoldingLimits(nearest_m=0.5, farthest_m=0.7, largest_tilt_deg=25)
    first = next_view(known(), BOARD, limits)
    assert 0.5 <= first.place.distance_m <= 0.7
    assert first.place.tilt_deg <= 25
    shown = simulated_views(RigidTransform.concatenate([first.T_camera_board]), 1e-6, 0)
    second = next_view(known(), BOARD, limits, shown)
    apart = CAMERA.project(second.T_camera_board.apply(BOARD.corners_m)) - shown[0].corners_px
    assert np.sqrt((apart**2).sum(axis=1).mean()) > 0.06 * 800 * 0.99


def test_without_any_view_the_board_is_tilted() -> None:
    first = next_view(Knowledge.rough((640, 480)), BOARD)
    assert first.place.tilt_deg > 10
    assert first.expected_px < 0.5 * first.now_px


@pytest.mark.parametrize(
    ("place", "last_m", "words"),
    [
        (
            Place((600.0, 440.0), 0.4, 9.0, -90.0),
            0.8,
            "at the lower right of the picture, its face turned 9 degrees to the top, nearer, 0.40",
        ),
        (
            Place((320.0, 240.0), 1.0, 0.0, 0.0),
            0.5,
            "in the middle of the picture, facing the camera, farther, 1.00",
        ),
        (
            Place((320.0, 470.0), 1.0, 20.0, 270.0),
            None,
            "at the bottom of the picture, its face turned 20 degrees to the top, 1.00",
        ),
        (
            Place((600.0, 240.0), 1.0, 20.0, 90.0),
            1.05,
            "at the right of the picture, its face turned 20 degrees to the bottom, 1.00",
        ),
    ],
)
def test_says_it_in_words(place: Place, last_m: float | None, words: str) -> None:
    assert describe(place, (640, 480), last_m) == f"hold the board {words} m away"


def test_refuses_where_there_is_no_place() -> None:
    near = HoldingLimits(nearest_m=0.01, farthest_m=0.05)
    with pytest.raises(InputError, match="no place within the limits shows enough of the board"):
        next_view(known(), BOARD, near)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"nearest_m": 2.0, "farthest_m": 1.0}, "nearest_m below farthest_m, got 2.0 and 1.0"),
        ({"largest_tilt_deg": 90.0}, "largest_tilt_deg between 0 and 80, got 90.0"),
    ],
)
def test_refuses_limits(words: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        HoldingLimits(**words)


def test_a_long_lens_is_guided_too() -> None:
    long = Camera(4000, 3000, (9000.0, 9000.0), (2000.0, 1500.0))
    poses = board_poses(8, seed=1, camera=CAMERA)
    far = RigidTransform.from_components(poses.translation * [1, 1, 12], poses.rotation)
    views = simulated_views(far, 0.1, 1, long)
    found = next_view(Knowledge.of_calibration(calibration_of(long, views, far)), BOARD)
    assert found.expected_px < found.now_px

"""The verdict: what it says of good, weak and treacherous calibrations, with the right numbers."""

from dataclasses import replace

import numpy as np
import pytest
from opencv_calibrations import (
    BOARD,
    CAMERA,
    board_poses,
    calibration_of,
    real_views,
    simulated_views,
    solved_by_opencv,
)

from tagmetry.calibrate.guidance import measure, verdict
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.camera import BrownLens
from tagmetry.errors import InputError


def has(warnings: tuple[str, ...], words: str) -> bool:
    return any(words in warning for warning in warnings)


def test_many_good_views_are_good() -> None:
    poses = board_poses(40, seed=1)
    calibration = calibration_of(CAMERA, simulated_views(poses, 0.08, seed=2), poses)
    found = verdict(calibration, BOARD)
    assert found.grade == "good"
    assert found.warnings == ()
    assert f"within {found.evidence.uncertainty.worst_px:.2f} px" in found.fit_for[0]
    assert "a marker of 50 mm in the middle of the image, 1 m away" in found.fit_for[1]
    assert found.next_view.text in found.words
    assert found.words.startswith("Good: 40 views")


def test_the_real_pictures_are_fit_for_the_middle_and_open_at_the_left_corners() -> None:
    found = verdict(calibrate(real_views(), "brown5"), BOARD)
    camera_sd = np.sqrt(np.diag(calibrate(real_views(), "brown5").camera.covariance))
    assert camera_sd[2] >= 1.2
    assert found.evidence.uncertainty.middle_px == pytest.approx(0.7, abs=0.3)
    assert found.grade == "usable"
    assert "left" in found.warnings[0]
    assert "no view shows the board there" in found.warnings[0]
    corners = found.evidence.uncertainty.sd_px
    assert min(corners[0, 0], corners[-1, 0]) > 4
    assert has(found.warnings, "two halves of the views")
    assert has(found.warnings, "errors within a view depend on each other: cx is known to")
    assert has(found.warnings, "the board's points are off by 0.09 px in the same way")
    assert has(found.warnings, "k2 (")
    assert found.next_view.place.pixel[0] < 320
    assert found.next_view.expected_px < 0.5 * found.next_view.now_px


def test_a_small_error_of_few_views_is_a_warning() -> None:
    few = solved_by_opencv(real_views()[:4], 5)
    found = verdict(few)
    assert few.rms_px < solved_by_opencv(real_views(), 5).rms_px
    assert found.grade != "good"
    assert found.next_view is None
    assert has(found.warnings, f"4 views are few: their error of {few.rms_px:.2f} px says nothing")


def test_a_fold_within_the_image_comes_first() -> None:
    poses = board_poses(12, seed=3)
    folding = replace(CAMERA, lens=BrownLens((-0.45, 0.0, 0.0, 0.0)), focal_px=(330.0, 330.0))
    views = simulated_views(poses, 0.05, 1, folding)
    found = verdict(calibration_of(folding, views, poses), BOARD)
    assert found.warnings[0].startswith(
        "the distortion is not one to one: it folds back 41 degrees"
    )
    assert found.grade != "good"


def test_coefficients_of_no_significance_are_named() -> None:
    poses = board_poses(12, seed=3)
    straight = replace(CAMERA, lens=BrownLens((0.0, 0.0, 0.0, 0.0)))
    calibration = solved_by_opencv(simulated_views(poses, 0.1, 1, straight), 4)
    weak = [w for w in verdict(calibration).warnings if w.startswith("not told apart from zero")]
    assert "k2 (" in weak[0]
    clear = verdict(
        calibration_of(CAMERA, simulated_views(board_poses(40, 1), 0.02, 1), board_poses(40, 1))
    )
    assert not has(clear.warnings, "not told apart")


def test_one_bad_view_is_named() -> None:
    poses = board_poses(14, seed=6)
    views = list(simulated_views(poses, 0.05, seed=2))
    x = views[7].p_board[:, :1] / 0.1
    views[7].corners_px[:] += 4.0 * x**2 * [1.0, 0.3]
    found = verdict(solved_by_opencv(views, 4))
    assert has(found.warnings, "one view decides: without view 7 projections move by")


def test_board_that_is_never_tilted_is_said_to_be() -> None:
    from tagmetry.calibrate.quality import Place, poses_at

    rng = np.random.default_rng(0)
    places = [
        Place(tuple(rng.uniform([220, 180], [420, 300])), 0.45, 8.0, a) for a in range(0, 360, 36)
    ]
    poses = poses_at(CAMERA, places)
    found = verdict(calibration_of(CAMERA, simulated_views(poses, 0.05, 1), poses))
    assert has(found.warnings, "the board is never tilted by more than 8 degrees")


def test_evidence_is_not_measured_twice() -> None:
    calibration = solved_by_opencv(real_views(), 4)
    evidence = measure(calibration, 0.02)
    found = verdict(calibration, evidence=evidence)
    assert found.evidence is evidence
    assert "a marker of 20 mm" in found.fit_for[-1]


def test_three_views_have_a_verdict_too() -> None:
    poses = board_poses(3, seed=2)
    found = verdict(calibration_of(CAMERA, simulated_views(poses, 0.1, 1), poses), BOARD)
    assert found.evidence.left_out is None
    assert found.evidence.halves is None
    assert has(found.warnings, "3 views are few")


def test_refuses_a_calibration_without_covariance() -> None:
    poses = board_poses(4, seed=2)
    calibration = calibration_of(CAMERA, simulated_views(poses, 0.1, 1), poses)
    with pytest.raises(InputError, match="whose camera has a covariance"):
        verdict(replace(calibration, camera=CAMERA))

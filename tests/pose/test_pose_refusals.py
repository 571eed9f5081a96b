"""What cannot be used is refused in words, or gives no hypothesis."""

import numpy as np
import pytest
from seen_markers import PINHOLE, corners_seen, detection, facing, flat_board, posed

from tagmetry.errors import InputError
from tagmetry.pose import estimate_body_pose, estimate_pose, estimate_poses

T = posed(facing(30), 0.0, 0.0, 1.0)
CORNERS = corners_seen(PINHOLE, T, 0.1)


@pytest.mark.parametrize("size_m", [0, -0.1, np.nan, np.inf])
def test_a_size_must_be_a_positive_number(size_m):
    with pytest.raises(InputError, match=f"positive number of metres, got {size_m}"):
        estimate_pose(detection(CORNERS), PINHOLE, size_m)


def test_every_marker_needs_a_size():
    with pytest.raises(InputError, match="expected 2 sizes, got 1"):
        estimate_poses([detection(CORNERS)] * 2, PINHOLE, [0.1])


def test_no_markers_have_no_poses():
    assert estimate_poses([], PINHOLE, []) == ()


BAD_COVARIANCES = {
    "zero": np.zeros((8, 8)),
    "singular": np.ones((8, 8)),
    "negative": -np.eye(8),
    "indefinite": np.diag([1.0] * 7 + [-1e-3]),
    "not finite": np.diag([1.0] * 7 + [np.nan]),
    "infinite": np.diag([1.0] * 7 + [np.inf]),
}


@pytest.mark.parametrize("kind", BAD_COVARIANCES)
def test_an_unusable_covariance_gives_no_hypothesis(kind):
    pose = estimate_pose(detection(CORNERS, BAD_COVARIANCES[kind]), PINHOLE, 0.1)
    assert pose.hypotheses == ()
    assert pose.alternatives == ()


@pytest.mark.parametrize("kind", BAD_COVARIANCES)
def test_a_body_passes_over_a_marker_with_an_unusable_covariance(kind):
    board = flat_board()
    good = [
        detection(corners_seen(PINHOLE, T * m.T_body_marker, m.size_m), 0.01, m.family, m.id)
        for m in board.markers
    ]
    bad = detection(good[0].corners_px, BAD_COVARIANCES[kind], "tag36h11", 0)
    pose = estimate_body_pose([bad, *good[1:]], board, PINHOLE)
    assert {key.id for key in pose.used} == {1, 2, 3, 4, 5}
    assert estimate_body_pose([bad], board, PINHOLE).hypotheses == ()


def test_an_empty_pose_has_no_best_and_says_why():
    pose = estimate_pose(detection(CORNERS[::-1]), PINHOLE, 0.1)
    assert pose.hypotheses == ()
    with pytest.raises(InputError, match="tag36h11 id 0 has no pose"):
        _ = pose.best
    with pytest.raises(InputError, match="has no pose"):
        _ = pose.covariance
    with pytest.raises(InputError, match="has no pose"):
        _ = pose.ambiguity


def test_a_body_that_is_not_seen_has_no_pose():
    stranger = detection(CORNERS, 0.01, "tag36h11", 77)
    other_family = detection(CORNERS, 0.01, "4x4_50", 0)
    pose = estimate_body_pose([stranger, other_family], flat_board(), PINHOLE)
    assert (pose.hypotheses, pose.used, pose.outliers) == ((), (), ())
    with pytest.raises(InputError, match="body 'board' has no pose"):
        _ = pose.best


def test_a_body_passes_over_a_marker_that_is_seen_twice():
    board = flat_board()
    seen = [
        detection(corners_seen(PINHOLE, T * m.T_body_marker, m.size_m), 0.01, m.family, m.id)
        for m in board.markers
    ]
    pose = estimate_body_pose([*seen, seen[2]], board, PINHOLE)
    assert {key.id for key in pose.used} == {0, 1, 3, 4, 5}


@pytest.mark.parametrize("count", [1, 6])
def test_a_body_whose_corners_are_not_numbers_has_no_pose(count):
    nowhere = [detection(np.full((4, 2), np.nan), 0.01, "tag36h11", n) for n in range(count)]
    assert estimate_body_pose(nowhere, flat_board(), PINHOLE).hypotheses == ()

"""Judging: what is right, what is false, how far off, against numbers made by hand."""

import numpy as np
import pytest
from fake_engines import Good, kind

from tagmetry.camera import Camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.lab.bench.agreement import agreed
from tagmetry.lab.bench.case import Case, Seen, Truth
from tagmetry.lab.bench.matching import matched
from tagmetry.lab.bench.poses import pose_errors
from tagmetry.lab.bench.rounds import Course
from tagmetry.lab.bench.score import scored
from tagmetry.lab.engines import Failure, Found
from tagmetry.markers import marker_corners_m

SQUARE = np.array([[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]])
IMAGE = np.zeros((100, 200), np.uint8)
SEEN = Seen(Camera(640, 480, (600.0, 600.0), (319.5, 239.5)), 0.1, 30.0, 210.0, 0.6, 1.0, noise=2.0)


def course(found: Found, times_s: tuple[float, ...] = (0.002,), name: str = "fake") -> Course:
    return Course(kind(Good, name, author=name), {0: found}, list(times_s), 12.0)


def truth(*ids: int) -> Truth:
    squares = [SQUARE + 50 * i for i in range(len(ids))]
    return Truth(np.array(ids, dtype=np.int64), np.array(squares).reshape(-1, 4, 2))


def case(*truths: Truth) -> Case:
    return Case("case", "tag36h11", (IMAGE,) * max(1, len(truths)), truths or None)


def test_matches_by_id_and_place() -> None:
    found = Found.of([5, 3, 3, 9], [SQUARE + 51, SQUARE + 2, SQUARE + 500, SQUARE + 100])
    pairs = matched(found, truth(3, 5, 4))
    assert list(zip(pairs.true, pairs.found, strict=True)) == [(0, 1), (1, 0)]
    assert pairs.false == 2


def test_of_two_on_one_marker_the_nearer_counts_and_the_other_is_false() -> None:
    pairs = matched(Found.of([3, 3], [SQUARE + 3, SQUARE + 1]), truth(3))
    assert pairs.found.tolist() == [1]
    assert pairs.false == 1


def test_a_marker_half_a_side_away_is_another() -> None:
    assert len(matched(Found.of([3], [SQUARE + np.array([9.9, 0.0])]), truth(3)).true) == 1
    assert len(matched(Found.of([3], [SQUARE + np.array([10.1, 0.0])]), truth(3)).true) == 0


def test_a_row_says_how_many_how_fast_and_how_far() -> None:
    off = SQUARE + np.array([[0.3, 0], [0, 0.3], [0.3, 0], [0, 0.3]])
    found = Found.of([3, 8], [off, SQUARE + 300])
    (row,) = scored(case(truth(3, 5)), [course(found, (0.001, 0.002, 0.009))], 1)
    assert (row.found, row.expected, row.recall, row.false_positives) == (1, 2, 0.5, 1)
    assert row.p50_ms == pytest.approx(2.0)
    assert row.p99_ms == pytest.approx(8.86)
    assert row.corner_rms_px == pytest.approx(0.3 / np.sqrt(2))
    assert (row.megapixels, row.rounds, row.memory_mib) == (0.02, 3, 12.0)
    assert row.position_error_percent is None
    assert row.distance2 is None


def test_stated_covariances_are_judged_by_what_happened() -> None:
    off = np.zeros((4, 2))
    off[0], off[2, 1] = [0.2, 0.0], 0.3
    doubted = np.diag([0.04, 1, 1, 1, 1, 0.01, 1, 1])  # 0.2 and 0.1 px of those two
    found = Found.of([3, 5], [SQUARE + off, SQUARE + 50], [doubted, np.eye(8)])
    (row,) = scored(case(truth(3, 5)), [course(found)], 1)
    assert row.distance2 == pytest.approx((1.0 + 9.0) / 2)


def test_ratios_are_to_our_own_detector() -> None:
    courses = [
        course(Found.of([], []), (0.002,), "tagmetry"),
        course(Found.of([], []), (0.006,), "peer"),
    ]
    assert [row.ratio for row in scored(case(truth()), courses, 1)] == pytest.approx([1.0, 3.0])


def test_a_failure_is_a_row_of_its_own() -> None:
    failed = Course(kind(Good), failure=Failure("crashed (SIGSEGV)"))
    (row,) = scored(case(truth(3)), [failed], 2)
    assert row.failure == "crashed (SIGSEGV)"
    assert row.p50_ms is None
    assert row.threads == 2


def turned(*tilts_deg: float) -> Rotation:
    angles_deg = [[180 + tilt_deg, 0, 20] for tilt_deg in tilts_deg]
    return Rotation.from_euler("xyz", angles_deg, degrees=True)


def corners_of(T_camera_marker: RigidTransform) -> np.ndarray:
    p_marker = marker_corners_m(np.array([SEEN.size_m]))[0]
    return SEEN.camera.project(T_camera_marker.apply(p_marker))


def test_exact_corners_give_exact_poses() -> None:
    T = RigidTransform.from_components([[0.1, 0.0, 1.0], [0.0, 0.1, 1.2]], turned(30, 40))
    errors = pose_errors(np.stack([corners_of(T[0]), corners_of(T[1])]), T, SEEN)
    assert max(errors.position_percent) < 1e-6
    assert max(errors.angle_deg) < 1e-5
    assert errors.flips == 0


def test_a_marker_that_seems_larger_is_nearer() -> None:
    T = RigidTransform.from_components([[0.0, 0.0, 1.0]], turned(30))
    corners = corners_of(T[0])
    middle = corners.mean(axis=0)
    errors = pose_errors((middle + 1.01 * (corners - middle))[None], T, SEEN)
    assert errors.position_percent[0] == pytest.approx(1.0, abs=0.1)


def test_corners_of_the_mirrored_pose_are_a_flip() -> None:
    true, mirrored = (
        RigidTransform.from_components([[0.0, 0.0, 2.0]], turned(tilt)) for tilt in (12, -12)
    )
    errors = pose_errors(corners_of(mirrored[0])[None], true, SEEN)
    assert errors.flips == 1


def test_variants_of_one_author_do_not_make_an_agreement() -> None:
    one = Course(kind(Good, "a-1", author="A"), {0: Found.of([3, 4], [SQUARE, SQUARE + 50])})
    two = Course(kind(Good, "a-2", author="A"), {0: Found.of([3, 4], [SQUARE, SQUARE + 50])})
    three = Course(kind(Good, "b", author="B"), {0: Found.of([4], [SQUARE + 50])})
    (common,) = agreed([one, two, three], images=1)
    assert common.ids.tolist() == [4]


def test_agreed_corners_lie_between_the_authors() -> None:
    courses = [
        Course(kind(Good, f"a-{off}", author="A"), {0: Found.of([3], [SQUARE + off])})
        for off in (5.0, 0.0, -0.1)
    ]
    courses.append(Course(kind(Good, "b", author="B"), {0: Found.of([3], [SQUARE + 0.4])}))
    (common,) = agreed(courses, images=1)
    np.testing.assert_allclose(common.corners_px, [SQUARE + 0.2])


def test_without_truth_rows_are_judged_by_agreement() -> None:
    courses = [
        course(Found.of([3], [SQUARE]), name="tagmetry"),
        course(Found.of([3, 5], [SQUARE, SQUARE + 50]), name="peer"),
    ]
    ours, peer = scored(case(), courses, 1)
    assert (ours.judged_by, ours.found, ours.expected, ours.false_positives) == (
        "agreement",
        1,
        1,
        0,
    )
    assert (peer.found, peer.false_positives) == (1, 1)

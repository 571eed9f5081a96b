"""Readings of squares: the best of each place, and what is reported of them."""

import numpy as np
import pytest

from tagmetry.detect.candidates import Candidates
from tagmetry.detect.detection import Rejection
from tagmetry.detect.report import detections, distinct_rejections
from tagmetry.detect.sides import Corners
from tagmetry.geometry import Array
from tagmetry.markers import family

FAMILIES = [family("tag36h11"), family("4x4_50")]
SQUARE_PX = np.array([[0, 0], [40, 0], [40, 40], [0, 40.0]])


def candidates(*rows: tuple[int, int, float, int, float, float]) -> Candidates:
    """Return upright squares of 40 px: family, id, left edge, wrong bits, confidence, outline."""
    families, ids, left, hamming, confidence, outline = (
        np.array(column) for column in zip(*rows, strict=True)
    )
    corners_px = SQUARE_PX + np.stack([left, np.full(len(rows), 50.0)], axis=1)[:, None]
    return Candidates(families, ids, ids < 0, corners_px, hamming, confidence, outline)


@pytest.mark.parametrize(
    ("other", "is_better"),
    [
        pytest.param((0, 8, 103.0, 0, 0.1, 0.1), True, id="fewer wrong bits"),
        pytest.param((0, 7, 103.0, 1, 0.9, 0.9), True, id="clearer"),
        pytest.param((0, 7, 103.0, 1, 0.9, 0.5), False, id="its sides are elsewhere"),
        pytest.param((0, 7, 103.0, 2, 1.0, 1.0), False, id="more wrong bits"),
    ],
)
def test_the_best_reading_of_a_place_remains(other: tuple, is_better: bool) -> None:
    for rows in ([(0, 7, 100.0, 1, 0.8, 0.8), other], [other, (0, 7, 100.0, 1, 0.8, 0.8)]):
        best = candidates(*rows).best_per_place()
        assert best.corners_px[:, 0, 0].tolist() == [103.0 if is_better else 100.0]


def test_they_stand_in_an_order_that_is_not_that_of_searching() -> None:
    rows = [(1, 2, 300.0, 0, 0.9, 0.9), (0, 9, 200.0, 0, 0.8, 0.9), (0, 5, 100.0, 1, 0.9, 0.9)]
    for turned in (rows, rows[::-1], rows[1:] + rows[:1]):
        best = candidates(*turned).best_per_place()
        assert list(zip(best.families, best.ids, strict=True)) == [(0, 5), (0, 9), (1, 2)]


def reported(found: Candidates, width_px: int) -> tuple:
    count = len(found)
    covariances: Array = np.tile(np.eye(8), (count, 1, 1))
    corners = Corners(found.corners_px, covariances, np.ones(count, dtype=bool))
    return detections(found, corners, FAMILIES, (width_px, 480))


def test_reports_are_ordered_by_name_and_id_and_say_what_stands_twice() -> None:
    found = candidates(
        (0, 3, 300.0, 0, 0.9, 0.9), (1, 4, 200.0, 2, 0.8, 0.9), (0, 3, 100.0, 1, 0.7, 0.9)
    )
    told = reported(found, 640)
    assert [(one.family, one.id, one.is_duplicate) for one in told] == [
        ("4x4_50", 4, False),
        ("tag36h11", 3, True),
        ("tag36h11", 3, True),
    ]
    assert [one.corners_px[0, 0] for one in told] == [200.0, 100.0, 300.0]
    assert [(one.hamming, one.confidence) for one in told] == [(2, 0.8), (1, 0.7), (0, 0.9)]
    assert isinstance(told[0].id, int)
    assert isinstance(told[0].confidence, float)


@pytest.mark.parametrize(("left_px", "touches"), [(1.0, True), (3.0, False), (458.5, True)])
def test_what_touches_the_edge_is_said(left_px: float, touches: bool) -> None:
    (told,) = reported(candidates((0, 3, left_px, 0, 0.9, 0.9)), 500)
    assert told.touches_border == touches


def test_a_place_is_turned_down_once_and_not_where_a_marker_stands() -> None:
    told = reported(candidates((0, 3, 100.0, 0, 0.9, 0.9)), 640)
    at = [Rejection(SQUARE_PX + np.array([x, 50.0]), str(x)) for x in (102.0, 300.0, 303.0, 500.0)]
    assert [one.reason for one in distinct_rejections(at, told)] == ["300.0", "500.0"]
    assert distinct_rejections([], ()) == ()

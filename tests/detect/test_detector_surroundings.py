"""What lies around, on and in a marker: neighbours, dirt, covers, borders, the picture's edge."""

import cv2
import numpy as np
import pytest
from drawn_markers import board, named, tile, wide
from rendered_markers import only, scene

from tagmetry.detect import Detector
from tagmetry.markers import family


def test_repeated_markers_are_flagged() -> None:
    found = Detector(["4x4_50"]).detect(board(("4x4_50", 9), ("4x4_50", 9), ("4x4_50", 4)))
    assert [(d.id, d.is_duplicate) for d in found] == [(4, False), (9, True), (9, True)]


def test_a_marker_at_the_picture_s_edge_is_flagged() -> None:
    picture = board(("tag36h11", 5))
    inner = only(Detector().detect(picture))
    assert not inner.touches_border
    left, top = np.rint(inner.corners_px.min(axis=0)).astype(int)
    for cut in (picture[:, left - 1 :], picture[top - 1 :]):
        assert all(d.touches_border for d in Detector().detect(np.ascontiguousarray(cut)))


def test_a_marker_within_a_marker() -> None:
    """A small one in a white cell of a large one: both are read."""
    cells = family("4x4_50").picture(0)
    large = np.pad(np.kron(cells, np.ones((80, 80))), 60, constant_values=1.0) * 180 + 40
    row, column = np.argwhere(cells)[0]
    tile = np.kron(family("tag36h11").picture(5), np.ones((5, 5))) * 180 + 40
    top, left = 60 + 80 * row + 20, 60 + 80 * column + 20
    large[top : top + 40, left : left + 40] = tile
    picture = cv2.GaussianBlur(large.astype(np.uint8), (0, 0), 0.7)
    assert named(Detector(["4x4_50", "tag36h11"]).detect(picture)) == [
        ("4x4_50", 0),
        ("tag36h11", 5),
    ]


def grid_with_dots(cell_px: int, overlap_px: int) -> np.ndarray:
    """Three by three markers with black squares between that reach into their corners."""
    side, gap = 8 * cell_px, 3 * cell_px
    sheet = np.full((4 * gap + 3 * side,) * 2, 210.0)
    for row, column in np.ndindex(3, 3):
        top, left = row * (side + gap) + gap, column * (side + gap) + gap
        picture = family("tag36h11").picture(3 * row + column)
        sheet[top : top + side, left : left + side] = np.kron(picture, np.ones((cell_px,) * 2))
    sheet = np.where(sheet <= 1, 170 * sheet + 40, sheet)
    for row, column in np.ndindex(4, 4):
        top, left = row * (side + gap), column * (side + gap)
        rows = slice(max(top - overlap_px, 0), top + gap + overlap_px)
        sheet[rows, max(left - overlap_px, 0) : left + gap + overlap_px] = 40
    return cv2.GaussianBlur(np.pad(sheet, 40, constant_values=210), (0, 0), 1.5)


@pytest.mark.parametrize(("cell_px", "overlap_px"), [(5, 0), (5, 1), (6, 2), (10, 2)])
def test_markers_that_touch_their_neighbours_are_found_beside_lone_ones(
    cell_px: int, overlap_px: int
) -> None:
    """A glance sees those of 40 px joined; as one that it sees has neighbours, it looks again."""
    grid = grid_with_dots(cell_px, overlap_px)
    picture = wide((50, 50, grid), (980, 700, tile(20, 9)), (1000, 500, tile(21, 4)))
    assert [d.id for d in Detector().detect(picture)] == [*range(9), 20, 21]


def test_a_marker_on_a_dark_ground_without_a_quiet_zone_is_not_seen() -> None:
    """What is as dark as the border has no edge with it; on any brighter ground it has."""
    no_zone = tile(5, 8, quiet_cells=0)
    assert Detector().detect(wide((500, 400, no_zone), ground=40.0)) == ()
    assert only(Detector().detect(wide((500, 400, no_zone), ground=120.0))).id == 5


@pytest.mark.parametrize("covered_cells", [0, 2, 4])
def test_dirt_on_the_bits_is_survived_up_to_what_the_code_corrects(covered_cells: int) -> None:
    marker = tile(5, 8)
    marker[24 : 24 + 8 * (covered_cells // 2), 24:40] = 210
    assert only(Detector(forgive_bits=5).detect(wide((500, 400, marker)))).id == 5


def test_a_covered_corner_moves_no_corner_by_much_or_the_marker_is_not_reported() -> None:
    """A sheet over a corner, larger and larger: no corner is ever invented."""
    corners = np.array([[8, 8], [72, 8], [72, 72], [8, 72]]) - 0.5 + np.array([500, 400])
    found = []
    for cover_px in range(0, 24, 3):
        marker = tile(5, 8)
        marker[: 8 + cover_px, : 8 + cover_px] = 210
        seen = Detector(forgive_bits=5).detect(wide((500, 400, marker)))
        found.append(len(seen))
        for detection in seen:
            np.testing.assert_allclose(detection.corners_px, corners, atol=1.0)
    assert found[:2] == [1, 1]
    assert found == sorted(found, reverse=True)


@pytest.mark.parametrize("marker_id", range(4))
def test_a_wide_border_is_not_taken_for_a_narrow_one(marker_id: int) -> None:
    """Its inner ring and its bits read well, but there is no edge where the corners would be."""
    shown = scene(
        np.random.default_rng(marker_id), 100.0, family="tag36h11_border2", marker_id=marker_id
    )
    for found in Detector(["tag36h11"]).detect(shown.grey):  # some still read, with wrong bits
        np.testing.assert_allclose(found.corners_px, shown.corners_px, atol=0.1)
        assert found.hamming > 0
    found = only(Detector(["tag36h11_border2"]).detect(shown.grey))
    np.testing.assert_allclose(found.corners_px, shown.corners_px, atol=0.1)


@pytest.mark.parametrize("marker_id", range(4))
def test_the_inside_of_a_wide_border_is_turned_down_where_bright_squares_count(
    marker_id: int,
) -> None:
    """`explain` and inverted markers look at bright squares as well; both must not fall for it."""
    shown = scene(
        np.random.default_rng(marker_id), 100.0, family="tag36h11_border2", marker_id=marker_id
    )
    findings = Detector(["tag36h11"]).explain(shown.grey)
    inverted_too = Detector(["tag36h11"], inverted=True).detect(shown.grey)
    for found in (*findings.detections, *inverted_too):
        np.testing.assert_allclose(found.corners_px, shown.corners_px, atol=0.1)

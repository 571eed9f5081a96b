"""What stands where on a page: nothing overlaps or leaves the margins, refusals give numbers."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.files.sheets import (
    Page,
    PageSetup,
    Paper,
    board_page,
    format_ids,
    marker_page,
    paper_names,
    parse_ids,
    parse_orientation,
    parse_paper,
    sheet_pages,
)
from tagmetry.files.sheets.outline import outlines_m
from tagmetry.files.sheets.page import Box, Cells, Text, text_width_m
from tagmetry.markers import (
    AprilGrid,
    CharucoBoard,
    Chessboard,
    GridBoard,
    Layout,
    MarkerFamily,
    family,
)

TAG = family("tag36h11")
TINY_M = 1e-9


def boxes(page: Page) -> list[Box]:
    """Everything on the page; the bars of the ruler touch, so they count as one."""
    loose = [shape.box for shape in page.shapes if not in_ruler(page, shape)]
    return [*loose, ruler_box(page)]


def ruler_bars(page: Page) -> list[Box]:
    """The ruler's line and ticks: the bars between the last block of cells and the last text."""
    bars = [shape.box for shape in page.shapes if isinstance(shape, Cells)]
    line = max(i for i, box in enumerate(bars) if box.height_m < 0.0003 < box.width_m - 0.005)
    return bars[line:]


def ruler_box(page: Page) -> Box:
    bars = ruler_bars(page)
    left, top = min(b.x_m for b in bars), min(b.y_m for b in bars)
    right, bottom = max(b.right_m for b in bars), max(b.bottom_m for b in bars)
    return Box(left, top, right - left, bottom - top)


def in_ruler(page: Page, shape: Cells | Text) -> bool:
    return isinstance(shape, Cells) and shape.box in ruler_bars(page)


def overlap(a: Box, b: Box) -> bool:
    across = min(a.right_m, b.right_m) - max(a.x_m, b.x_m)
    down = min(a.bottom_m, b.bottom_m) - max(a.y_m, b.y_m)
    return across > TINY_M and down > TINY_M


def assert_tidy(page: Page, margin_m: float) -> None:
    for box in boxes(page):
        assert box.x_m >= margin_m - TINY_M
        assert box.y_m >= margin_m - TINY_M
        assert box.right_m <= page.width_m - margin_m + TINY_M
        assert box.bottom_m <= page.height_m - margin_m + TINY_M
    assert not [pair for pair in combinations(boxes(page), 2) if overlap(*pair)]


@settings(max_examples=60, deadline=None)
@given(
    paper=st.sampled_from(["a4", "a5", "a6", "letter", "legal", "70x90mm", "300x40cm"]),
    orientation=st.sampled_from(["auto", "portrait", "landscape"]),
    size_mm=st.floats(3, 250),
    count=st.integers(1, 30),
    margin_mm=st.floats(0, 20),
    quiet_cells=st.integers(1, 3),
)
@example("a4", "portrait", 148.0, 1, 10.0, 1)
def test_what_fits_keeps_to_its_place(
    paper: str, orientation: str, size_mm: float, count: int, margin_mm: float, quiet_cells: int
) -> None:
    setup = PageSetup(
        parse_paper(paper), parse_orientation(orientation), margin_mm / 1000, quiet_cells
    )
    try:
        pages = sheet_pages(TAG, range(count), size_mm / 1000, setup)
    except InputError as refusal:
        assert "the page leaves" in str(refusal)  # noqa: PT017 (a refusal is one of two outcomes)
        return
    for page in pages:
        assert_tidy(page, margin_mm / 1000)
    assert sum(len(markers(page)) for page in pages) == count


def markers(page: Page) -> list[Cells]:
    return [s for s in page.shapes if isinstance(s, Cells) and s.filled.size > 1]


@settings(max_examples=40, deadline=None)
@given(size_mm=st.floats(3, 40), quiet_cells=st.integers(1, 3), paper=st.sampled_from(["a4", "a6"]))
def test_the_quiet_zone_is_white(size_mm: float, quiet_cells: int, paper: str) -> None:
    setup = PageSetup(parse_paper(paper), quiet_cells=quiet_cells)
    (page, *_) = sheet_pages(TAG, range(20), size_mm / 1000, setup)
    quiet_m = quiet_cells * size_mm / 1000 / 8
    for marker in markers(page):
        zone = marker.box.shrunk(-quiet_m)
        others = [shape.box for shape in page.shapes if shape is not marker]
        assert not [box for box in others if overlap(zone, box)]


@pytest.mark.parametrize("columns", [1, 2])
def test_the_largest_size_that_a_refusal_names_fits_and_more_does_not(columns: int) -> None:
    board = GridBoard(columns, 2, 0.4, 0.1)
    with pytest.raises(InputError, match=r"the largest size that fits is ([\d.]+) mm") as refusal:
        board_page(board)
    size_m = float(str(refusal.value).split()[-2]) / 1000
    board_page(GridBoard(columns, 2, size_m, size_m / 4))
    with pytest.raises(InputError, match="the largest size"):
        board_page(GridBoard(columns, 2, size_m + 0.0001, size_m / 4 + 0.000025))


def test_a_refusal_tells_what_was_needed_and_what_the_page_leaves() -> None:
    with pytest.raises(
        InputError,
        match=r"size 300 mm needs 375 mm x 379\.5 mm .* leaves 185 mm x 256 mm \(a4 portrait\) or "
        r"272 mm x 169 mm \(a4 landscape\); the largest size that fits is 148 mm",
    ):
        marker_page(TAG, 7, 0.3)


@pytest.mark.parametrize("steps", [1, 4, 10])
def test_the_ruler_is_the_longest_that_fits(steps: int) -> None:
    width_m = 0.020 + 0.010 * steps + 0.009
    page = marker_page(TAG, 7, 0.005, PageSetup(Paper("strip", width_m, 0.2)))
    box = ruler_box(page)
    assert box.width_m == pytest.approx(0.010 * steps, abs=1e-12)
    assert len(ruler_bars(page)) == 1 + steps + 1
    notes = " ".join(shape.text for shape in page.shapes if isinstance(shape, Text))
    assert f"must be exactly {10 * steps}.0 mm" in notes
    assert "Print at 100 %, do not fit to page." in notes


def test_inner_ticks_stand_at_whole_centimetres() -> None:
    first, *ticks = ruler_bars(marker_page(TAG, 7, 0.05))
    middles = [tick.x_m + tick.width_m / 2 - first.x_m for tick in ticks]
    np.testing.assert_allclose(middles[1:-1], np.arange(1, 10) * 0.010, atol=1e-4)
    assert middles[5] == pytest.approx(0.050, abs=1e-12)


def test_a_page_says_what_it_shows() -> None:
    texts = [s.text for s in sheet_pages(TAG, [7, 8, 9, 30], 0.04)[0].shapes if isinstance(s, Text)]
    assert "tag36h11, id 30, 40 mm" in texts
    assert any(t.startswith("tag36h11, ids 7-9, 30, 40 mm, tagmetry ") for t in texts)


@pytest.mark.parametrize(
    ("size_mm", "label"),
    [(40, "tag36h11, id 30, 40 mm"), (10, "tag36h11, id 30"), (5, "id 30"), (1, "30")],
)
def test_labels_get_shorter_before_they_get_illegible(size_mm: float, label: str) -> None:
    (page,) = sheet_pages(TAG, [30], size_mm / 1000)
    shown = next(shape for shape in page.shapes if isinstance(shape, Text))
    assert shown.text == label
    assert shown.size_m >= 0.0014 or label == "30"


def test_auto_turns_the_page_when_only_that_fits() -> None:
    wide = board_page(GridBoard(5, 2, 0.04, 0.01))
    assert (wide.width_m, wide.height_m) == (0.297, 0.210)
    with pytest.raises(InputError, match=r"\(a4 portrait\); the largest"):
        board_page(GridBoard(5, 2, 0.04, 0.01), PageSetup(orientation="portrait"))


def test_bits_outside_the_border_get_room() -> None:
    layout = Layout(6, 1, ((-1, -1), (6, -1), (6, 6), (-1, 6), (2, 2), (3, 2), (3, 3), (2, 3)))
    outer = MarkerFamily("outer", layout, np.zeros((1, 8), dtype=bool), 0)
    page = marker_page(outer, 0, 0.06)
    (marker,) = markers(page)
    assert marker.box.width_m == pytest.approx(0.08)
    assert page.width_m / 2 == pytest.approx(marker.box.x_m + marker.box.width_m / 2)


@settings(max_examples=80, deadline=None)
@given(st.integers(1, 9), st.integers(1, 9), st.integers(0, 2**32 - 1))
def test_outlines_enclose_just_the_filled_cells(rows: int, columns: int, seed: int) -> None:
    filled = np.random.default_rng(seed).random((rows, columns)) < 0.5
    loops = outlines_m(Cells(Box(0.0, 0.0, columns, rows), filled))
    area = sum(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2 for x, y in (p.T for p in loops))
    assert area == filled.sum()
    inside = np.zeros_like(filled)
    for row, column in np.ndindex(rows, columns):
        crossings = [crossed(loop, column + 0.5, row + 0.5) for loop in loops]
        inside[row, column] = sum(crossings) % 2
    np.testing.assert_array_equal(inside, filled)


def crossed(loop: np.ndarray, x: float, y: float) -> int:
    """How many sides of the loop a ray to the right of the point crosses."""
    ends = np.roll(loop, -1, axis=0)
    spans = (np.minimum(loop, ends)[:, 1] < y) & (np.maximum(loop, ends)[:, 1] > y)
    return int((spans & (loop[:, 0] > x)).sum())


def test_a_solid_block_has_one_outline_of_four_corners() -> None:
    (loop,) = outlines_m(Cells(Box(1.0, 2.0, 3.0, 4.0), np.ones((7, 5), dtype=bool)))
    assert {tuple(corner) for corner in loop.tolist()} == {(1, 2), (4, 2), (4, 6), (1, 6)}


@given(st.lists(st.integers(0, 586), min_size=1, max_size=40))
def test_ids_read_back(ids: list[int]) -> None:
    assert parse_ids(format_ids(ids), TAG) == tuple(ids)


def test_ids_as_promised() -> None:
    assert parse_ids("0-3,30", TAG) == (0, 1, 2, 3, 30)
    assert parse_ids(" ALL ", TAG) == tuple(range(587))
    assert format_ids([0, 1, 2, 5]) == "0-2, 5"


@pytest.mark.parametrize("text", ["", ",", "a", "1-", "-1", "1-2-3", "1.5", "1;2", "9" * 5000])
def test_refuses_what_is_no_list_of_ids(text: str) -> None:
    with pytest.raises(InputError, match="expected ids like 0-23,30 or all, found"):
        parse_ids(text, TAG)


@pytest.mark.parametrize(
    ("text", "match"),
    [
        ("3-1", "ids must rise within a range"),
        ("587", "there is no id 587"),
        ("0-999999999", "there is no id 999999999"),
    ],
)
def test_refuses_ids_that_are_not_there(text: str, match: str) -> None:
    with pytest.raises(InputError, match=match):
        parse_ids(text, TAG)


def test_papers() -> None:
    assert parse_paper(" A4 ") == Paper("a4", 0.210, 0.297)
    assert parse_paper("letter").height_m == pytest.approx(0.2794)
    assert parse_paper("100 x 50mm").width_m == pytest.approx(0.1)
    assert set(paper_names()) == {f"a{n}" for n in range(7)} | {"letter", "legal", "tabloid"}


@pytest.mark.parametrize("text", ["", "a7", "210x297", "x", "-1x2mm", "1x2x3mm", "nanxnanmm"])
def test_refuses_unknown_paper_and_lists_those_there_are(text: str) -> None:
    with pytest.raises(InputError, match=r"unknown paper .* there are a0, .* like 210x297mm"):
        parse_paper(text)


@pytest.mark.parametrize("text", ["0x297mm", "1..2x3mm"])
def test_refuses_paper_without_a_size(text: str) -> None:
    with pytest.raises(InputError, match="expected a length above 0"):
        parse_paper(text)


def test_refuses_what_no_file_can_hold() -> None:
    with pytest.raises(InputError, match="up to 5080 mm long, got 6000 mm x 100 mm"):
        parse_paper("600x10cm")


@pytest.mark.parametrize(
    ("change", "match"),
    [
        ({"margin_m": -0.01}, "margin must be 0 or more"),
        ({"margin_m": float("nan")}, "margin must be 0 or more"),
        ({"quiet_cells": 0}, "quiet zone of at least 1 cell, got 0"),
    ],
)
def test_refuses_a_setup_that_cannot_be(change: dict[str, float], match: str) -> None:
    with pytest.raises(InputError, match=match):
        PageSetup(**change)  # type: ignore[arg-type]


def test_refuses_an_unknown_orientation() -> None:
    with pytest.raises(InputError, match="one of auto, portrait, landscape, got 'sideways'"):
        parse_orientation("sideways")


@pytest.mark.parametrize("margin_m", [0.1, 0.105, 3.0])
def test_refuses_margins_that_leave_nothing(margin_m: float) -> None:
    with pytest.raises(InputError, match="too little for the ruler and the caption"):
        marker_page(TAG, 7, 0.01, PageSetup(margin_m=margin_m))


@pytest.mark.parametrize("size_m", [0.0, -1.0, float("nan"), float("inf"), 1e-7])
def test_refuses_sizes_that_cannot_be_printed(size_m: float) -> None:
    with pytest.raises(InputError, match=r"size must be at least 0\.1 mm, got"):
        marker_page(TAG, 7, size_m)


@pytest.mark.parametrize("size_m", [1.0, 1e6, 1e300])
def test_refuses_giants(size_m: float) -> None:
    with pytest.raises(InputError, match="the largest size that fits"):
        marker_page(TAG, 7, size_m)


@pytest.mark.parametrize("marker_id", [-1, 587, 10**30])
def test_refuses_an_id_that_the_family_lacks(marker_id: int) -> None:
    with pytest.raises(InputError, match="tag36h11 has ids 0 to 586, there is no id"):
        marker_page(TAG, marker_id, 0.05)


def test_refuses_an_empty_sheet() -> None:
    with pytest.raises(InputError, match="at least one id"):
        sheet_pages(TAG, [], 0.05)


@pytest.mark.parametrize(
    ("board", "match"),
    [
        (GridBoard(30, 30, 0.001, 0.001), "there is no id 899"),
        (GridBoard(10**9, 10**9, 0.001, 0.001), "there is no id"),
        (GridBoard(2, 2, 0.08, 0.009), r"gap leaves 9 mm .* at least one cell, 10 mm"),
        (AprilGrid(2, 2, 0.08, 0.05), r"spacing leaves 4 mm .* at least one cell, 8 mm"),
        (Chessboard(10**6, 10**6, 0.001), "up to 100000 places, got 1000002000001"),
        (CharucoBoard(40, 40, 0.004, 0.003), "there is no id 799"),
        (Chessboard(8, 5, 1e-9), r"square must be at least 0\.1 mm"),
        (CharucoBoard(5, 7, 0.02, 1e-9), r"size must be at least 0\.1 mm"),
    ],
)
def test_refuses_boards_that_cannot_be_printed(board: GridBoard, match: str) -> None:
    with pytest.raises(InputError, match=match):
        board_page(board)


def test_a_gap_of_just_one_cell_is_enough() -> None:
    assert_tidy(board_page(GridBoard(3, 2, 0.04, 0.005)), 0.010)


def test_long_captions_and_names_wrap() -> None:
    name = "ж" * 300
    strange = MarkerFamily(name, TAG.layout, TAG.codes, 0)
    (page,) = sheet_pages(strange, range(0, 60, 2), 0.02, PageSetup(parse_paper("a4")))
    assert_tidy(page, 0.010)
    assert all(s.shown.isascii() for s in page.shapes if isinstance(s, Text))
    assert page.title.isascii()
    assert text_width_m("W" * 10, 0.003) == pytest.approx(0.0285)

"""What stands where on a page: nothing overlaps or leaves the margins."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from sheet_shapes import TAG, assert_tidy, markers, overlap, ruler_bars, ruler_box

from tagmetry.errors import InputError
from tagmetry.files.sheets import (
    PageSetup,
    Paper,
    board_page,
    marker_page,
    parse_orientation,
    parse_paper,
    sheet_pages,
)
from tagmetry.files.sheets.page import Text, text_width_m
from tagmetry.markers import GridBoard, Layout, MarkerFamily


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

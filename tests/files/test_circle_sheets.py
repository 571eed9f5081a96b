"""Printed circle grids, read by OpenCV's finder and measured against a circle's area."""

import io

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.files.sheets import Page, PageSetup, board_page, page_as_svg, pages_as_pdf
from tagmetry.files.sheets.page import Disc
from tagmetry.files.sheets.raster import page_as_pixels
from tagmetry.markers import CircleGrid

PIXELS_PER_M = 3000.0
STRAIGHT = CircleGrid(6, 4, 0.025, 0.015)
STAGGERED = CircleGrid(4, 7, 0.02, 0.014, asymmetric=True)


def discs(page: Page) -> list[Disc]:
    return [shape for shape in page.shapes if isinstance(shape, Disc)]


def centres_px(page: Page) -> np.ndarray:
    return np.array([(one.x_m, one.y_m) for one in discs(page)]) * PIXELS_PER_M - 0.5


@pytest.mark.parametrize("board", [STRAIGHT, STAGGERED])
def test_opencv_finds_the_discs_where_they_were_printed(board: CircleGrid) -> None:
    page = board_page(board)
    kind = cv2.CALIB_CB_ASYMMETRIC_GRID if board.asymmetric else cv2.CALIB_CB_SYMMETRIC_GRID
    found, centres = cv2.findCirclesGrid(
        page_as_pixels(page, PIXELS_PER_M), (board.columns, board.rows), flags=kind
    )
    assert found
    measured, expected = centres.reshape(-1, 2), centres_px(page)
    if measured[0] @ [1, 1] > measured[-1] @ [1, 1]:
        measured = measured[::-1]
    np.testing.assert_allclose(measured, expected, atol=0.2)


def test_a_disc_s_ink_is_its_area_and_its_middle_is_its_centre() -> None:
    page = Page(0.03, 0.02, (Disc(0.0131, 0.0092, 0.00617),), "disc")
    dark = (255.0 - page_as_pixels(page, 2500.0)) / 255
    assert dark.sum() == pytest.approx(np.pi * (0.00617 * 2500) ** 2, rel=1e-3)
    y, x = np.indices(dark.shape) + 0.5
    middle = np.array([(dark * x).sum(), (dark * y).sum()]) / dark.sum()
    np.testing.assert_allclose(middle, [0.0131 * 2500, 0.0092 * 2500], atol=0.01)


def test_a_disc_over_the_page_s_edge_is_cut() -> None:
    page = Page(0.01, 0.01, (Disc(0.0, 0.005, 0.002), Disc(0.02, 0.02, 0.001)), "cut")
    pixels = page_as_pixels(page, 1000.0)
    assert pixels[5, 0] == 0
    assert pixels[5, 3] == 255


def test_a_pdf_shows_the_same_as_a_png() -> None:
    pdfium = pytest.importorskip("pypdfium2")
    page = board_page(STAGGERED)
    document = pdfium.PdfDocument(io.BytesIO(pages_as_pdf([page])))
    shown = document[0].render(scale=PIXELS_PER_M * 0.0254 / 72).to_numpy()[..., 0]
    ours = page_as_pixels(page, PIXELS_PER_M)
    for x, y in np.rint(centres_px(page)).astype(int):
        around = slice(y - 30, y + 31), slice(x - 30, x + 31)
        assert abs(float(shown[around].mean()) - float(ours[around].mean())) < 3


def test_an_svg_has_a_circle_for_each_disc() -> None:
    drawn = page_as_svg(board_page(STRAIGHT))
    assert drawn.count("<circle ") == 24
    assert drawn.count('r="7.5"') == 24


def test_an_inverted_grid_is_white_on_black() -> None:
    page = board_page(STRAIGHT, PageSetup(inverted=True))
    pixels = page_as_pixels(page, PIXELS_PER_M)
    (x, y), *_ = np.rint(centres_px(page)).astype(int)
    assert pixels[y, x] == 255
    assert pixels[y, x + round(0.01 * PIXELS_PER_M)] == 0


def test_the_title_says_what_it_is() -> None:
    title = "Asymmetric circles 4x7, pitch 20 mm, diameter 14 mm"
    assert board_page(STAGGERED).title == title


def test_refuses_a_grid_that_does_not_fit() -> None:
    with pytest.raises(InputError, match="the largest diameter that fits"):
        board_page(CircleGrid(20, 20, 0.05, 0.02))

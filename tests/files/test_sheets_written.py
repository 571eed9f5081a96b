"""Sheets as they come out of the file again: rendered by PDFium, read as XML, decoded by OpenCV."""

import re
import struct
import sys
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.files.sheets import (
    Page,
    PageSetup,
    board_page,
    marker_page,
    page_as_png,
    page_as_svg,
    pages_as_pdf,
    parse_paper,
    sheet_pages,
    write_pages,
)
from tagmetry.files.sheets.page import Box, Cells, Text, bar
from tagmetry.files.sheets.raster import page_as_pixels
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import AprilGrid, CharucoBoard, family

TAG = family("tag36h11")
LETTER = PageSetup(parse_paper("letter"))  # a whole number of pixels at 600 dpi
SVG = "{http://www.w3.org/2000/svg}"


def rendered(pages: Sequence[Page], dpi: float, number: int = 0) -> GreyPixels:
    pdfium = pytest.importorskip("pypdfium2", reason="needs pypdfium2 to render PDF")
    with pdfium.PdfDocument(pages_as_pdf(pages)) as document:
        scale = dpi / 72 * (1 - 1e-9)  # or rounding would add a pixel and stretch the page to it
        return document[number].render(scale=scale, grayscale=True).to_numpy().squeeze().copy()


def largest_dark_box(pixels: GreyPixels) -> tuple[int, int, int, int]:
    """Left, top, width and height of the largest connected dark area, pixels."""
    dark = (pixels < 128).astype(np.uint8)
    _, _, stats, _ = cv2.connectedComponentsWithStats(dark)
    largest = 1 + stats[1:, cv2.CC_STAT_AREA].argmax()
    return tuple(stats[largest, :4].tolist())


def darkness_px(line: np.ndarray) -> float:
    """How many pixels of a line are dark, counting grey ones in part."""
    return float((255.0 - line).sum() / 255)


def marker_of(page: Page) -> Cells:
    return next(s for s in page.shapes if isinstance(s, Cells) and s.filled.size > 1)


@pytest.mark.parametrize("size_mm", [120.0, 33.3])
def test_pdf_marker_has_its_size_at_600_dpi(size_mm: float) -> None:
    pixels = rendered([marker_page(TAG, 7, size_mm / 1000, LETTER)], 600)
    expected_px = size_mm / 25.4 * 600
    left, top, width, height = largest_dark_box(pixels)
    half_cell_px = int(expected_px / 16)
    across = pixels[top + half_cell_px, left - 5 : left + width + 5]
    down = pixels[top - 5 : top + height + 5, left + half_cell_px]
    assert darkness_px(across) == pytest.approx(expected_px, abs=0.25)
    assert darkness_px(down) == pytest.approx(expected_px, abs=0.25)
    assert abs(left + width / 2 - pixels.shape[1] / 2) < 1  # in the middle of the page


def test_pdf_ruler_is_100_mm_long() -> None:
    pixels = rendered([marker_page(TAG, 7, 0.05, LETTER)], 600)
    margin_px = 10 / 25.4 * 600
    foot = pixels[-round(3 * margin_px) :]
    line = foot[(255.0 - foot).sum(axis=1).argmax()]  # the row with the most ink
    assert darkness_px(line) == pytest.approx(100 / 25.4 * 600, rel=0.25)  # a hair has grey rows
    dark = np.flatnonzero(line < 250)
    assert dark[-1] + 1 - dark[0] == pytest.approx(100 / 25.4 * 600, abs=1)
    assert dark[0] == pytest.approx(margin_px, abs=1)


@pytest.mark.parametrize("name", ["4x4_50", "7x7_1000", "aruco_original", "tag25h9"])
def test_pdf_cells_are_those_of_the_family(name: str) -> None:
    tags = family(name)
    page = marker_page(tags, 17, 0.08, LETTER)
    pixels = rendered([page], 150)
    cells = tags.picture(17)
    left, top, width, height = largest_dark_box(pixels)
    centre = (np.arange(len(cells)) + 0.5) / len(cells)
    sampled = pixels[
        np.ix_((top + centre * height).astype(int), (left + centre * width).astype(int))
    ]
    np.testing.assert_array_equal(sampled, np.where(cells, 255, 0))


@pytest.mark.parametrize("dpi", [60, 97, 300])
@pytest.mark.parametrize("inverted", [False, True])
def test_pdf_equals_our_own_pixels_without_hairlines(dpi: float, inverted: bool) -> None:
    setup = PageSetup(parse_paper("8x10in"), inverted=inverted)
    page = board_page(CharucoBoard(5, 7, 0.0273, 0.0207), setup)
    theirs = rendered([page], dpi)
    ours = page_as_pixels(page, dpi / 0.0254)
    rows = slice(0, int(0.8 * len(ours)))  # above the texts
    for grey in (0, 255):
        inside = cv2.erode((ours[rows] == grey).astype(np.uint8), np.ones((3, 3))) > 0
        assert inside.mean() > 0.1
        assert np.abs(theirs[rows][inside].astype(int) - grey).max() <= 1


@pytest.mark.parametrize("anchor", ["start", "middle"])
@pytest.mark.parametrize(
    "text", ["tag36h11, id 7, 120 mm", "WWW @@ mmm %%", "4x4_50, ids 0-23, 30"]
)
@pytest.mark.parametrize("writer", ["pdf", "png"])
def test_texts_stay_in_their_boxes(anchor: str, text: str, writer: str) -> None:
    shape = Text(0.0508, 0.0127, 0.005, text, anchor)  # type: ignore[arg-type]
    page = Page(0.1016, 0.0254, (shape,), "")
    pixels = rendered([page], 300) if writer == "pdf" else page_as_pixels(page, 300 / 0.0254)
    rows, columns = (
        np.flatnonzero((pixels < 128).any(axis=axis)) / 300 * 0.0254 for axis in (1, 0)
    )
    assert shape.box.x_m <= columns[0]
    assert columns[-1] <= shape.box.right_m
    assert shape.box.y_m <= rows[0]
    assert rows[-1] <= shape.box.bottom_m
    middle_m = (columns[0] + columns[-1]) / 2 if anchor == "middle" else columns[0]
    assert middle_m == pytest.approx(0.0508, abs=0.0008)


def test_pdf_has_all_pages_and_always_the_same_bytes() -> None:
    pages = sheet_pages(TAG, range(30), 0.04)
    content = pages_as_pdf(pages)
    assert content == pages_as_pdf(sheet_pages(TAG, range(30), 0.04))
    assert content.startswith(b"%PDF")
    assert b"/PrintScaling /None" in content
    last = rendered(pages, 50, len(pages) - 1)
    assert last.shape == (585, 414)


def test_pdf_and_svg_hold_the_same_geometry() -> None:
    pdfium = pytest.importorskip("pypdfium2", reason="needs pypdfium2 to read PDF")
    page = board_page(AprilGrid(3, 2, 0.04, 0.3))
    with pdfium.PdfDocument(pages_as_pdf([page])) as document:
        paths = [o for o in document[0].get_objects() if o.type == pdfium.raw.FPDF_PAGEOBJ_PATH]
        bounds_points = np.array([path.get_bounds() for path in paths])
    left, bottom, right, top = (bounds_points * 25.4 / 72).T
    height = 1000 * page.height_m
    from_pdf = np.stack([left, height - top, right, height - bottom], axis=1)
    from_svg = np.array([np.r_[p.min(axis=0), p.max(axis=0)] for p in svg_paths(page)])
    np.testing.assert_allclose(from_pdf, from_svg, atol=0.001)


def svg_paths(page: Page) -> list[np.ndarray]:
    """The corners of all loops of each path, millimetres, (n, 2)."""
    root = ET.fromstring(page_as_svg(page))  # noqa: S314 (our own drawing)
    return [
        np.array(
            [pair.split(",") for pair in re.findall(r"[\d.]+,[\d.]+", path.attrib["d"])], float
        )
        for path in root.iter(f"{SVG}path")
    ]


def test_svg_is_in_millimetres_with_the_marker_at_its_size() -> None:
    page = marker_page(TAG, 7, 0.12)
    root = ET.fromstring(page_as_svg(page))  # noqa: S314 (our own drawing)
    assert (root.attrib["width"], root.attrib["height"]) == ("210mm", "297mm")
    assert root.attrib["viewBox"] == "0 0 210 297"
    marker, *_ = svg_paths(page)
    np.testing.assert_allclose(np.ptp(marker, axis=0), 120, atol=1e-6)
    widths = [np.ptp(path[:, 0]) for path in svg_paths(page)[1:]]
    assert max(widths) == pytest.approx(100, abs=1e-6)  # the ruler


def test_svg_areas_are_those_of_the_black_cells() -> None:
    root = ET.fromstring(page_as_svg(marker_page(TAG, 7, 0.08)))  # noqa: S314 (our own drawing)
    drawn = next(root.iter(f"{SVG}path")).attrib["d"]
    loops = [
        np.array([pair.split(",") for pair in loop.strip("MZ").split("L")], float)
        for loop in drawn.split("Z")[:-1]
    ]
    area = sum(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2 for x, y in (p.T for p in loops))
    assert area == pytest.approx(100 * (~TAG.picture(7)).sum())


def test_svg_escapes_its_texts() -> None:
    page = marker_page(TAG, 7, 0.05)
    svg = page_as_svg(Page(page.width_m, page.height_m, page.shapes, "<&>"))
    assert ET.fromstring(svg).findtext(f"{SVG}title") == "<&>"  # noqa: S314 (our own drawing)


@pytest.mark.parametrize("dpi", [72, 300, 600])
def test_png_states_its_resolution_and_keeps_the_size(dpi: int) -> None:
    content = page_as_png(marker_page(TAG, 7, 0.05, PageSetup(parse_paper("a6"))), dpi)
    at = content.index(b"pHYs") + 4
    per_metre = struct.unpack(">IIB", content[at : at + 9])
    assert per_metre == (round(dpi / 0.0254), round(dpi / 0.0254), 1)
    pixels = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    left, top, width, _ = largest_dark_box(pixels)
    row = pixels[top + width // 16, left - 3 : left + width + 3]
    assert darkness_px(row) == pytest.approx(0.05 * per_metre[0], abs=0.01)


def test_pixels_are_exact_shares_of_area() -> None:
    page = Page(0.004, 0.003, (bar(0.00125, 0.0005, 0.0015, 0.001),), "")
    np.testing.assert_array_equal(
        255 - page_as_pixels(page, 1000.0),
        [[0, 96, 96, 0], [0, 96, 96, 0], [0, 0, 0, 0]],  # 3/8 of 255
    )


def test_white_ink_covers_black() -> None:
    ground = bar(0.0, 0.0, 0.004, 0.004)
    white = Cells(Box(0.001, 0.001, 0.002, 0.002), np.eye(2, dtype=bool), "white")
    pixels = page_as_pixels(Page(0.004, 0.004, (ground, white), ""), 1000.0)
    np.testing.assert_array_equal(pixels[1:3, 1:3], [[255, 0], [0, 255]])
    assert pixels.sum() == 2 * 255


def test_inverted_markers_swap_black_and_white_and_have_a_black_quiet_zone() -> None:
    plain = marker_page(TAG, 7, 0.05, LETTER)
    inverted = marker_page(TAG, 7, 0.05, PageSetup(LETTER.paper, inverted=True))
    zone_m = marker_of(plain).box.shrunk(-0.05 / 8)
    a, b = (page_as_pixels(page, 4000.0) for page in (plain, inverted))
    rows = slice(round(4000 * zone_m.y_m) + 1, round(4000 * zone_m.bottom_m) - 1)
    columns = slice(round(4000 * zone_m.x_m) + 1, round(4000 * zone_m.right_m) - 1)
    total = a[rows, columns].astype(int) + b[rows, columns]
    assert abs(total - 255).max() <= 1
    assert b[rows, columns][:20].max() == 0


@pytest.mark.parametrize("suffix", [".pdf", ".svg", ".png", ".PDF"])
def test_writes_one_page_to_the_name_itself(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"marker{suffix}"
    assert write_pages([marker_page(TAG, 7, 0.05)], path, dpi=50) == (path,)
    assert [p.name for p in tmp_path.iterdir()] == [path.name]


def test_writes_many_pages_with_numbers(tmp_path: Path) -> None:
    pages = sheet_pages(TAG, range(30), 0.04)
    paths = write_pages(pages, tmp_path / "sheet.svg")
    assert [path.name for path in paths] == ["sheet-1.svg", "sheet-2.svg", "sheet-3.svg"]
    assert "id 29," in paths[-1].read_text()


@pytest.mark.parametrize("name", ["a.txt", "a", ".pdf", "a.pdf.zip"])
def test_refuses_unknown_suffixes_and_lists_those_there_are(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=r"cannot write '.*': a sheet is \.pdf, \.svg, \.png"):
        write_pages([marker_page(TAG, 7, 0.05)], tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_refuses_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no folder"):
        write_pages([marker_page(TAG, 7, 0.05)], tmp_path / "none" / "a.svg")


@pytest.mark.parametrize("dpi", [0, -1, float("nan"), float("inf"), 1e9])
def test_refuses_resolutions_that_cannot_be(dpi: float) -> None:
    with pytest.raises(InputError, match="dpi must be 10 to 10000, got"):
        page_as_png(marker_page(TAG, 7, 0.05), dpi)


def test_refuses_a_picture_that_is_too_large() -> None:
    page = marker_page(TAG, 7, 0.05, PageSetup(parse_paper("a0")))
    with pytest.raises(InputError, match=r"1200 dpi make a picture of 39\d+x56\d+ pixels"):
        page_as_png(page, 1200)


def test_names_the_extra_when_reportlab_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "reportlab.pdfgen.canvas", None)
    with pytest.raises(MissingExtraError, match=r"writing PDF needs .*tagmetry\[print\]"):
        pages_as_pdf([marker_page(TAG, 7, 0.05)])

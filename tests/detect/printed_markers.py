"""Markers as printed by the sheets, seen at an angle by OpenCV's warp: a renderer of its own."""

import cv2
import numpy as np

from tagmetry.files.sheets import Page, sheet_pages
from tagmetry.files.sheets.page import Cells
from tagmetry.files.sheets.raster import page_as_pixels
from tagmetry.geometry import Array
from tagmetry.markers import MarkerFamily

PIXELS_PER_M = 2500.0
SIZE_M = 0.024  # 60 px


def printed(family: MarkerFamily, ids: list[int]) -> list[tuple[np.ndarray, dict[int, Array]]]:
    """Return each page of a sheet as pixels, with its markers' corners (4, 2) by id."""
    sheets, left = [], list(ids)
    for page in sheet_pages(family, ids, SIZE_M):
        here = [_corners_px(shape, family) for shape in _markers(page)]
        sheets.append((page_as_pixels(page, PIXELS_PER_M), dict(zip(left, here, strict=False))))
        left = left[len(here) :]
    assert not left
    return sheets


def seen(sheet: np.ndarray, corners_px: dict[int, Array], quarters: int):
    """Return a page turned by quarters and seen at an angle, and where its corners are then."""
    height, width = sheet.shape
    page = np.array([[0, 0], [width, 0], [width, height], [0, height]], dtype=np.float32)
    bent = page + np.array([[0, 0], [-40, 30], [-90, -20], [50, -60]], dtype=np.float32)
    H = cv2.getPerspectiveTransform(page, np.roll(bent, -quarters, axis=0)).astype(np.float64)
    size = (width, height)
    if quarters % 2:  # the page's long side lies along the picture's
        stretch = np.diag([height / width, width / height, 1.0])
        H, size = stretch @ H, (height, width)
    # sample within the pixel: OpenCV's pixel centres are whole numbers as ours are
    picture = cv2.warpPerspective(sheet, H, size, flags=cv2.INTER_AREA, borderValue=255)
    picture = cv2.GaussianBlur(picture, (0, 0), 0.6)
    return picture, {i: cv2.perspectiveTransform(c[None], H)[0] for i, c in corners_px.items()}


def _markers(page: Page) -> list[Cells]:
    return [s for s in page.shapes if isinstance(s, Cells) and s.filled.size > 1]


def _corners_px(cells: Cells, family: MarkerFamily) -> Array:
    margin = family.layout.margin_cells
    box = cells.box.shrunk(cells.box.width_m * margin / len(cells.filled))
    x, y = [box.x_m, box.right_m], [box.y_m, box.bottom_m]
    corners_m = np.array([[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]])
    return corners_m * PIXELS_PER_M - 0.5

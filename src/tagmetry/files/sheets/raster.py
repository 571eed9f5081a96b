"""Pages as pixels: each pixel's grey is the share of it that the ink leaves white.

The shares are exact areas (a disc's to a thousandth). Where a cell ends within a pixel the pixel is
grey, so an edge is where it should be whatever the resolution.
"""

import numpy as np

from tagmetry.files.sheets.page import Cells, Disc, Page, Text
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels

_BAND_PX = 256
_CHORDS = 16  # per row of pixels of a disc


def page_as_pixels(page: Page, pixels_per_m: float) -> GreyPixels:
    """Return a page as a grey image; pixel (0, 0) begins at the page's top left corner.

    Args:
        page: The page.
        pixels_per_m: The resolution.
    """
    height_px, width_px = page_size_px(page, pixels_per_m)
    pixels = np.full((height_px, width_px), 255, dtype=np.uint8)
    for shape in page.shapes:
        if isinstance(shape, Cells):
            _fill(pixels, shape, pixels_per_m)
        elif isinstance(shape, Disc):
            _fill_disc(pixels, shape, pixels_per_m)
        else:
            _write(pixels, shape, pixels_per_m)
    return pixels


def page_size_px(page: Page, pixels_per_m: float) -> tuple[int, int]:
    """Return how many rows and columns of pixels cover a page."""
    return (
        max(1, round(page.height_m * pixels_per_m)),
        max(1, round(page.width_m * pixels_per_m)),
    )


def _fill(pixels: GreyPixels, cells: Cells, pixels_per_m: float) -> None:
    """Cover the pixels under the cells, some rows at a time to save memory."""
    box, filled = cells.box, cells.filled.astype(np.float64)
    rows, columns = cells.filled.shape
    left, across = _shares(box.x_m, box.width_m, columns, pixels_per_m, pixels.shape[1])
    top, down = _shares(box.y_m, box.height_m, rows, pixels_per_m, pixels.shape[0])
    ink = 0.0 if cells.ink == "black" else 255.0
    for first in range(0, len(down), _BAND_PX):
        share = down[first : first + _BAND_PX] @ filled @ across.T
        band = pixels[top + first :, left:][: share.shape[0], : share.shape[1]]
        band[:] = np.rint(band + share * (ink - band))


def _fill_disc(pixels: GreyPixels, disc: Disc, pixels_per_m: float) -> None:
    """Cover the pixels under a disc, chord by chord."""
    x_px, y_px, radius_px = (v * pixels_per_m for v in (disc.x_m, disc.y_m, disc.radius_m))
    top, bottom = _span(y_px, radius_px, pixels.shape[0])
    left, right = _span(x_px, radius_px, pixels.shape[1])
    across_px = np.arange(left, right)
    ink = 0.0 if disc.ink == "black" else 255.0
    for row in range(top, bottom):
        chord_y_px = row + (np.arange(_CHORDS)[:, None] + 0.5) / _CHORDS - y_px
        half_px = np.sqrt(np.maximum(radius_px**2 - chord_y_px**2, 0.0))
        ends, starts = (
            np.minimum(across_px + 1, x_px + half_px),
            np.maximum(across_px, x_px - half_px),
        )
        share = np.maximum(ends - starts, 0.0).mean(axis=0)
        band = pixels[row, left:right]
        band[:] = np.rint(band + share * (ink - band))


def _span(middle_px: float, radius_px: float, most_px: int) -> tuple[int, int]:
    """Return the first pixel that a disc touches, and the one after the last."""
    first, last = np.floor(middle_px - radius_px), np.ceil(middle_px + radius_px)
    return int(np.clip(first, 0, most_px)), int(np.clip(last, 0, most_px))


def _shares(
    start_m: float, length_m: float, count: int, pixels_per_m: float, most_px: int
) -> tuple[int, Array]:
    """Return the first pixel under a row of cells, and the share of each under each, (n, count)."""
    edges_px = _snapped((start_m + length_m * np.arange(count + 1) / count) * pixels_per_m)
    edges_px = np.clip(edges_px, 0, most_px)
    first, last = int(edges_px[0]), int(np.ceil(edges_px[-1]))
    pixel = np.arange(first, last)[:, None]
    overlap = np.minimum(pixel + 1, edges_px[1:]) - np.maximum(pixel, edges_px[:-1])
    return first, np.maximum(overlap, 0.0)


def _snapped(edges_px: Array) -> Array:
    """Take away what rounding adds to whole pixels, else a hair of grey would stand beside them."""
    whole_px = np.rint(edges_px)
    return np.where(np.abs(edges_px - whole_px) < 1e-6, whole_px, edges_px)


def _write(pixels: GreyPixels, text: Text, pixels_per_m: float) -> None:
    """Write a text, smaller when the font is wider than the room."""
    import cv2

    font, room_px = cv2.FontFace("sans"), text.box.width_m * pixels_per_m
    for size_px in range(int(text.size_m * pixels_per_m), 0, -1):
        _, _, width_px, _ = cv2.getTextSize((0, 0), text.shown, (0, 0), font, size_px)
        if width_px <= room_px:
            left_px = text.x_m * pixels_per_m - (width_px / 2 if text.anchor == "middle" else 0)
            at = (round(left_px), round(text.baseline_m * pixels_per_m))
            cv2.putText(pixels, text.shown, at, 0, font, size_px)
            return

"""The same image by the textbook's way, with OpenCV: what the published systems show.

Seed 003, table 2: colour, grey, Canny edges, contours. Seed 001, figure 8: adaptive threshold,
contours and those with four corners, the marker straightened and parted into cells, its id, its
corners by lines through the edges.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels, BoolArray, GreyPixels
from tagmetry.markers import Layout

_CANNY = (50, 150)
_WINDOW_SHARE = 0.03  # of the image's width, for the adaptive threshold
_OFFSET = 7
_STRAY = 0.03  # how far a polygon may stray from its contour, as a share of its length
_LEAST_AREA_PX2 = 64.0
_CELL_PX = 16


@dataclass(frozen=True, eq=False)
class Classic:
    """What each step of the textbook gives.

    Attributes:
        edges: Canny's, shape (h, w).
        is_dark: By the adaptive threshold, shape (h, w).
        contours: Of the dark areas, shapes (m, 2).
        quads: Contours with four corners, shape (n, 4, 2).
    """

    edges: BoolArray
    is_dark: BoolArray
    contours: tuple[Array, ...]
    quads: Array


@dataclass(frozen=True, eq=False)
class Straightened:
    """One marker seen as if from the front.

    Attributes:
        grey: Its cells, `_CELL_PX` pixels each.
        is_white: By Otsu's threshold, like `grey`.
        bits: Which cells are mostly white, shape (cells, cells).
    """

    grey: GreyPixels
    is_white: BoolArray
    bits: BoolArray


def classic(grey: GreyPixels) -> Classic:
    """Return the steps up to the quadrilaterals."""
    window = max(3, int(_WINDOW_SHARE * grey.shape[1]) // 2 * 2 + 1)
    dark = cv2.adaptiveThreshold(
        grey, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV, window, _OFFSET
    )
    found, _ = cv2.findContours(dark, cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
    contours = tuple(np.asarray(one.reshape(-1, 2), dtype=np.float64) for one in found)
    quads = [quad for one in found if (quad := _quad(one)) is not None]
    edges = cv2.Canny(grey, *_CANNY)
    return Classic(edges > 0, dark > 0, contours, np.array(quads).reshape(-1, 4, 2))


def straightened(grey: GreyPixels, corners_px: Array, layout: Layout) -> Straightened:
    """Return a marker with corners (4, 2), clockwise from its top left, as seen from the front."""
    cells = layout.side_cells + 2 * layout.margin_cells
    low, high = layout.margin_cells * _CELL_PX - 0.5, (cells - layout.margin_cells) * _CELL_PX - 0.5
    square = np.array([[low, low], [high, low], [high, high], [low, high]], dtype=np.float32)
    H = cv2.getPerspectiveTransform(corners_px.astype(np.float32), square)
    flat = cv2.warpPerspective(grey, H, (cells * _CELL_PX,) * 2, borderMode=cv2.BORDER_REPLICATE)
    _, binary = cv2.threshold(flat, 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)
    shares = (binary > 0).reshape(cells, _CELL_PX, cells, _CELL_PX).mean(axis=(1, 3))
    return Straightened(np.asarray(flat, dtype=np.uint8), binary > 0, shares > 0.5)


def _quad(contour: AnyPixels) -> Array | None:
    """Return the corners of a contour that is a quadrilateral, (4, 2)."""
    length = cv2.arcLength(contour, closed=True)
    polygon = cv2.approxPolyDP(contour, _STRAY * length, closed=True)
    if len(polygon) != 4 or not cv2.isContourConvex(polygon):
        return None
    if cv2.contourArea(polygon) < _LEAST_AREA_PX2:
        return None
    return np.asarray(polygon.reshape(4, 2), dtype=np.float64)

"""Find a board of markers in rows and columns; any part of it will do.

A plain grid's corners are the detector's, with its covariance. On an AprilGrid a small black square
touches every corner, which disturbs the detector's sides and makes the corner a crossing of two
edges: it is fitted like that of a chessboard.
"""

import numpy as np

from tagmetry.calibrate.targets.corners import Guesses, refined
from tagmetry.calibrate.targets.found import DroppedPoint, Found, NotFound
from tagmetry.calibrate.targets.seen_markers import SeenMarkers, see_markers
from tagmetry.calibrate.view import mean_sd_px
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels, IntArray
from tagmetry.markers import AprilGrid, GridBoard, family

_EDGE_PX = 2.0
_WORST_SD_PX = 1.0
_WITHIN = 0.95  # share of the border or of the small square that a corner's window may reach


def find_grid(grey: GreyPixels, board: GridBoard) -> Found | NotFound:
    """Return the corners of a grid's markers, with the detector's own covariance.

    Args:
        grey: 8-bit image, shape (height, width).
        board: What to look for.
    """
    seen = see_markers(grey, board)
    return _corners(grey, seen) if seen.agree.any() else _nothing(board, seen)


def find_aprilgrid(grey: GreyPixels, board: AprilGrid) -> Found | NotFound:
    """Return the corners of an AprilGrid's tags, each fitted as a crossing of two edges.

    Args:
        grey: 8-bit image, shape (height, width).
        board: What to look for.
    """
    seen = see_markers(grey, board)
    if not seen.agree.any():
        return _nothing(board.grid, seen)
    sure = seen.agreeing()
    layout = family(board.family).layout
    half = _WITHIN * min(layout.border_cells / layout.side_cells, board.spacing)
    return refined(grey, _guesses(board, sure), half=half)


def _guesses(board: AprilGrid, seen: SeenMarkers) -> Guesses:
    """Return the tags' corners with the sides that meet there, those to the right and down."""
    points, corners_px = _points(seen), seen.corners_px
    along_px = corners_px[:, [1, 1, 2, 2]] - corners_px[:, [0, 0, 3, 3]]
    down_px = corners_px[:, [3, 2, 2, 3]] - corners_px[:, [0, 1, 1, 0]]
    in_picture = (part.reshape(-1, 2) for part in (corners_px, along_px, down_px))
    return Guesses(points, board.corners_m[points, :2], *in_picture)


def _nothing(board: GridBoard, seen: SeenMarkers) -> NotFound:
    count = board.columns * board.rows
    reason = f"none of the board's {count} markers ({board.family}) is seen"
    return NotFound(reason, seen.corners_px.reshape(-1, 2))


def _points(seen: SeenMarkers) -> IntArray:
    return np.asarray((4 * seen.places[:, None] + np.arange(4)).ravel(), dtype=np.int64)


def _corners(grey: GreyPixels, seen: SeenMarkers) -> Found:
    points, places_px = _points(seen), seen.corners_px.reshape(-1, 2)
    covariances_px2 = _own_blocks(seen.covariances_px2)
    sd_px = mean_sd_px(covariances_px2)
    limit_px = np.array(grey.shape[::-1]) - 1 - _EDGE_PX
    at_edge = ((places_px < _EDGE_PX) | (places_px > limit_px)).any(axis=1)
    reasons = (
        (np.repeat(~seen.agree, 4), "its marker is not where the others say"),
        (np.asarray(at_edge), "at the picture's edge"),
        (sd_px > _WORST_SD_PX, f"uncertain by more than {_WORST_SD_PX:g} px"),
    )
    bad = np.array([is_bad for is_bad, _ in reasons]).any(axis=0)
    dropped = tuple(
        DroppedPoint(
            int(points[i]), places_px[i], next(why for is_bad, why in reasons if is_bad[i])
        )
        for i in np.flatnonzero(bad)
    )
    return Found(points[~bad], places_px[~bad], covariances_px2[~bad], dropped)


def _own_blocks(covariances_px2: Array) -> Array:
    """Return each corner's own covariance (4 n, 2, 2) out of those of whole markers (n, 8, 8)."""
    blocks = covariances_px2.reshape(-1, 4, 2, 4, 2)
    return np.concatenate([blocks[:, k, :, k] for k in range(4)], axis=1).reshape(-1, 2, 2)

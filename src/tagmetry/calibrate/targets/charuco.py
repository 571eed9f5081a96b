"""Find a ChArUco board, or a part of it: markers say which corner is which and about where.

Each chessboard corner is predicted from the markers around it by a homography of its own, which
follows a lens' distortion, and fitted to the pixels like any chessboard corner, without the pixels
that may belong to a marker.
"""

from dataclasses import replace

import numpy as np

from tagmetry.calibrate.targets.corners import Guesses, refined
from tagmetry.calibrate.targets.found import Found, NotFound
from tagmetry.calibrate.targets.homography import fitted_homography
from tagmetry.calibrate.targets.seen_markers import SeenMarkers, off_plane, see_markers
from tagmetry.geometry import Array, apply_homography
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import CharucoBoard

_AROUND = 1.9  # squares from a corner to the centres of the markers that predict it
_TOUCHING = 0.75  # squares from a corner to the centres of the markers that touch it
_LEAST_ARM_PX, _LEAK_PX = 1.5, 2.0
_LEAST_SHARE = 0.6
_DOUBTFUL = 0.05  # sides of a marker, mean


def find_charuco(grey: GreyPixels, board: CharucoBoard) -> Found | NotFound:
    """Return the chessboard corners of a ChArUco board.

    Args:
        grey: 8-bit image, shape (height, width).
        board: What to look for.
    """
    seen = see_markers(grey, board)
    count = len(board.markers())
    if not len(seen.places):
        return NotFound(f"none of the board's {count} markers ({board.family}) is seen")
    if (reason := _disagreement(board, seen)) is not None:
        return NotFound(reason, seen.corners_px.reshape(-1, 2))
    return _corners(grey, board, seen.agreeing())


def _disagreement(board: CharucoBoard, seen: SeenMarkers) -> str | None:
    """Say that the markers are arranged otherwise, and how if it is the other layout."""
    told = f"{len(seen.places)} markers are seen, but not arranged as this board's"
    other = replace(board, legacy=not board.legacy)
    if _misfit(other, seen) < _misfit(board, seen) - _DOUBTFUL:
        layout = "old layout (legacy)" if other.legacy else "new layout (not legacy)"
        return f"{told}; they fit the {layout}"
    if seen.agree.mean() < _LEAST_SHARE:
        return f"{told}; check columns, rows and the first id"
    return None


def _misfit(board: CharucoBoard, seen: SeenMarkers) -> float:
    """Return how far the markers are off, in sides of a marker, one that is lost counting as 1."""
    off = off_plane(board, seen.places, seen.corners_px)
    return float(np.minimum(off, 1.0).mean())


def _corners(grey: GreyPixels, board: CharucoBoard, seen: SeenMarkers) -> Found | NotFound:
    points, predicted = [], []
    markers_m = np.stack([marker.corners_m[:, :2] for marker in board.markers()])[seen.places]
    distances = (
        np.linalg.norm(board.corners_m[:, None, :2] - markers_m.mean(axis=1), axis=2)
        / board.square_m
    )  # of every corner from every marker, in squares
    for point, near in enumerate(distances):
        if near.min() < _TOUCHING:
            around = near < _AROUND
            place = board.corners_m[point, :2]
            points.append(point)
            predicted.append(_predict(place, markers_m[around], seen.corners_px[around], board))
    if not points:
        return NotFound("markers of the board are seen, but none at a corner of its squares")
    places_px, right_px, below_px = np.moveaxis(np.array(predicted), 1, 0)
    along_px, down_px = right_px - places_px, below_px - places_px
    places_m = board.corners_m[points, :2]
    guesses = Guesses(np.array(points), places_m, places_px, along_px, down_px)
    return refined(grey, guesses, arm=_arm(board, along_px))


def _predict(place_m: Array, markers_m: Array, markers_px: Array, board: CharucoBoard) -> Array:
    """Return where a corner and its next ones to the right and below are, shape (3, 2)."""
    H = fitted_homography(markers_m.reshape(-1, 2), markers_px.reshape(-1, 2))
    steps = board.square_m * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, -1.0]])
    return apply_homography(H, place_m + steps)


def _arm(board: CharucoBoard, along_px: Array) -> float:
    """Return how far from an edge no marker lies, in squares, less what blur carries over."""
    square_px = max(1.0, float(np.nanmedian(np.linalg.norm(along_px, axis=1))))
    white_px = square_px * (1 - board.size_m / board.square_m) / 2
    return max(_LEAST_ARM_PX, white_px - _LEAK_PX) / square_px

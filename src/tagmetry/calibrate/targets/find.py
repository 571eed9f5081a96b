"""Find a board in a picture, whatever board it is, and say why where it is not found."""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.targets.charuco import find_charuco
from tagmetry.calibrate.targets.chessboard import find_chessboard
from tagmetry.calibrate.targets.circles import find_circles
from tagmetry.calibrate.targets.found import DroppedPoint, Found, NotFound
from tagmetry.calibrate.targets.grids import find_aprilgrid, find_grid
from tagmetry.calibrate.targets.patches import Patches
from tagmetry.calibrate.targets.quality import QualityLimits, ViewQuality, view_quality
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.detect.grey import SMALLEST_SIDE_PX, grey_8bit
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, CircleGrid, GridBoard

LEAST_POINTS = 6
_LEAST_WIDTH = 0.02  # of a line of points: its width by its length
_LIMITS = QualityLimits()


@dataclass(frozen=True, eq=False)
class BoardFindings:
    """All that looking for a board gave.

    Attributes:
        result: The view, or why there is none.
        dropped: Points that were seen and not believed, each with the reason.
        quality: What the picture is like around the points, where enough were seen.
        patches: The pixels around each corner of the view, to fit it again (`refitted`); None for
            boards whose points are not crossings of edges.
    """

    result: BoardView | RejectedView
    dropped: tuple[DroppedPoint, ...] = ()
    quality: ViewQuality | None = None
    patches: Patches | None = None


def find_board(
    image: AnyPixels,
    board: Board,
    *,
    source: str = "",
    limits: QualityLimits = _LIMITS,
    thorough: bool = True,
) -> BoardView | RejectedView:
    """Return the board's points in a picture, or why there are none.

    Args:
        image: Grey or BGR, uint8 or uint16, shape (h, w) or (h, w, 3).
        board: What to look for. Boards of markers may be seen in part.
        source: What to call the picture.
        limits: Blurred, moved or overexposed views are rejected.
        thorough: Where the quick finder of chessboards sees nothing, try the slow one.

    Raises:
        InputError: The array is no image, or there is no finder for such a board.
    """
    return explain_board(image, board, source=source, limits=limits, thorough=thorough).result


def explain_board(
    image: AnyPixels,
    board: Board,
    *,
    source: str = "",
    limits: QualityLimits = _LIMITS,
    thorough: bool = True,
) -> BoardFindings:
    """Return the view as `find_board` does, with the points dropped and the picture's quality."""
    if _is_tiny(image):
        return BoardFindings(RejectedView(source, f"too small a picture: {_size(image)} pixels"))
    grey = grey_8bit(image)
    found = _found(grey, board, thorough=thorough)
    if isinstance(found, NotFound):
        return BoardFindings(RejectedView(source, found.reason, found.seen_px))
    if (reason := _too_little(found)) is not None:
        return BoardFindings(RejectedView(source, reason, found.corners_px), found.dropped)
    view = _view(grey, board, found, source)
    quality = view_quality(grey, view)
    if (reason := limits.refusal(quality)) is not None:
        rejected = RejectedView(source, reason, found.corners_px)
        return BoardFindings(rejected, found.dropped, quality)
    return BoardFindings(view, found.dropped, quality, found.patches)


def _found(grey: GreyPixels, board: Board, *, thorough: bool) -> Found | NotFound:
    match board:
        case Chessboard():
            return find_chessboard(grey, board, thorough=thorough)
        case CharucoBoard():
            return find_charuco(grey, board)
        case GridBoard():
            return find_grid(grey, board)
        case AprilGrid():
            return find_aprilgrid(grey, board)
        case CircleGrid():
            return find_circles(grey, board)
    raise InputError(f"there is no finder for a board of type {type(board).__name__}")


def _too_little(found: Found) -> str | None:
    """Return why the points cannot fix the board's place, None when they can."""
    count = len(found.points)
    if count < LEAST_POINTS:
        why = f": {found.dropped[0].reason}" if found.dropped else ""
        lost = f", {len(found.dropped)} dropped{why}" if found.dropped else ""
        return f"only {count} points are good, at least {LEAST_POINTS} are needed{lost}"
    spread = np.linalg.svd(found.corners_px - found.corners_px.mean(axis=0), compute_uv=False)
    if spread[1] < _LEAST_WIDTH * spread[0]:
        return f"the {count} points lie on one line"
    return None


def _view(grey: GreyPixels, board: Board, found: Found, source: str) -> BoardView:
    height_px, width_px = grey.shape
    p_board = board.corners_m[found.points]
    places = (found.corners_px, found.covariances_px2)
    return BoardView(width_px, height_px, found.points, p_board, *places, source)


def _is_tiny(image: AnyPixels) -> bool:
    """Return whether it is an image too small for any board; what is no image is not."""
    shape = np.shape(image)
    return len(shape) in (2, 3) and min(shape[:2]) < SMALLEST_SIDE_PX


def _size(image: AnyPixels) -> str:
    return f"{image.shape[1]}x{image.shape[0]}"

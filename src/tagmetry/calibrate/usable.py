"""Which views can take part at all, before anything is solved."""

from collections.abc import Sequence

import numpy as np

from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.errors import InputError
from tagmetry.geometry import Array

LEAST_VIEWS = 3
LEAST_CORNERS = 6
_LEAST_BREADTH_PX = 2.0
_THICKEST = 0.1  # of a board's breadth: beyond, it is no flat board


def usable_views(
    views: Sequence[BoardView],
) -> tuple[tuple[BoardView, ...], tuple[RejectedView, ...]]:
    """Return the views that can be used, and the others with the reason.

    Raises:
        InputError: Fewer than three can.
    """
    usable: list[BoardView] = []
    rejected = []
    for view in views:
        fault = _fault(view) or _repeats(view, usable)
        if fault:
            rejected.append(RejectedView(view.source, fault))
        else:
            usable.append(view)
    check_enough(len(usable), tuple(rejected))
    return tuple(usable), tuple(rejected)


def check_enough(usable: int, rejected: tuple[RejectedView, ...]) -> None:
    """Raise InputError when too few views are left."""
    if usable < LEAST_VIEWS:
        why = f"; {rejected[0].source or 'one'}: {rejected[0].reason}" if rejected else ""
        raise InputError(
            f"expected at least {LEAST_VIEWS} views of the board at different tilts, got {usable} "
            f"that can be used and {len(rejected)} that cannot{why}"
        )


def check_flat(p_board: Array) -> None:
    """Raise InputError for points (k, 3) that do not lie about in a plane."""
    spread = np.linalg.svd(p_board - p_board.mean(axis=0), compute_uv=False)
    if spread[2] > _THICKEST * spread[1]:
        raise InputError(
            f"expected the points of a flat board, these lie up to {spread[2] / spread[1]:.0%} of "
            f"its breadth out of their plane; calibrate with a flat board"
        )


def _fault(view: BoardView) -> str:
    """Return what makes a view useless, in words; empty if nothing does."""
    if len(view.points) < LEAST_CORNERS:
        return f"{len(view.points)} corners, at least {LEAST_CORNERS} are needed"
    if view.points[0] < 0 or (np.diff(view.points) <= 0).any():
        return "its points do not rise: a point is there twice or out of order"
    return _shape_fault(view)


def _shape_fault(view: BoardView) -> str:
    low, high = view.corners_px.min(axis=0), view.corners_px.max(axis=0)
    if (low < -0.5).any() or (high > np.array(view.size_px) - 0.5).any():
        return f"corners lie outside of its {view.width_px}x{view.height_px} pixels"
    length, breadth = _breadths(view.p_board)[:2]
    if breadth < 1e-3 * length:
        return "its points lie on one line of the board"
    if _breadths(view.corners_px)[1] < _LEAST_BREADTH_PX:
        return "its corners lie on one line of the picture: the board is seen edge on"
    return ""


def _repeats(view: BoardView, before: Sequence[BoardView]) -> str:
    for other in before:
        same = view.size_px == other.size_px and np.array_equal(view.points, other.points)
        if same and np.abs(view.corners_px - other.corners_px).max() < 1e-3:
            return f"it shows exactly what {other.source or 'another view'} shows"
    return ""


def _breadths(points: Array) -> Array:
    """Return the standard deviations of points along their principal axes, longest first."""
    centred = points - points.mean(axis=0)
    return np.asarray(np.linalg.svd(centred, compute_uv=False) / np.sqrt(len(points)))

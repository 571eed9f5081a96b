"""The one picture to add next: of all places the one after which least is uncertain."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.guidance.candidates import HoldingLimits, candidates
from tagmetry.calibrate.guidance.knowledge import Knowledge, bundle_at
from tagmetry.calibrate.guidance.words import describe
from tagmetry.calibrate.quality.places import Place
from tagmetry.calibrate.view import BoardView
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Board

_LIMITS = HoldingLimits()
_SIDE_POINTS = 12


@dataclass(frozen=True, eq=False)
class NextView:
    """Where to hold the board.

    Attributes:
        place: In the picture, how far, how tilted.
        T_camera_board: The pose there.
        outline_px: The board's edge in the picture from its top left, clockwise, shape (n, 2), to
            be matched; NaN for what the lens does not show.
        now_px: Largest standard deviation of projections over the image now.
        expected_px: The same with this view.
        text: What to do, in words.
    """

    place: Place
    T_camera_board: RigidTransform
    outline_px: Array
    now_px: float
    expected_px: float
    text: str


def next_view(
    known: Knowledge,
    board: Board,
    limits: HoldingLimits = _LIMITS,
    taken: Sequence[BoardView] = (),
    last_distance_m: float | None = None,
) -> NextView:
    """Return where the board is to be held next.

    Args:
        known: What is known of the camera so far.
        board: The board.
        limits: How it can be held.
        taken: Views that are not to be repeated while there are other places.
        last_distance_m: Where it is now, to say nearer or farther.

    Raises:
        InputError: No place within the limits shows enough of the board.
    """
    tried = candidates(known, board, limits, taken)
    expected = known.worst_with_px(known.of_views(tried.bundle, tried.seen))
    best = int(np.nanargmin(expected))
    place = tried.places[best]
    R, t = tried.bundle.R_camera_board[best], tried.bundle.t_camera_board[best]
    T = RigidTransform.from_components(t, Rotation.from_matrix(R))
    return NextView(
        place,
        T,
        bundle_at(known.camera, R[None], t[None], _edge_m(board)).predict()[0],
        known.worst_px,
        float(expected[best]),
        describe(place, known.camera.size_px, last_distance_m),
    )


def _edge_m(board: Board) -> Array:
    """Return points along the pattern's edge, clockwise from its top left, shape (n, 3)."""
    x, y = board.width_m / 2, board.height_m / 2
    corners = np.array([[-x, y, 0], [x, y, 0], [x, -y, 0], [-x, -y, 0]])
    share = np.arange(_SIDE_POINTS)[:, None] / _SIDE_POINTS
    sides = [a + share * (b - a) for a, b in zip(corners, np.roll(corners, -1, 0), strict=True)]
    return np.concatenate(sides)

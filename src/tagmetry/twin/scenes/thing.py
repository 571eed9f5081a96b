"""Things that a scene is made of: markers, boards, bodies, boxes and plain surfaces.

Frames: a thing's own frame is its marker's, its board's or its body's.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import Board, MarkerBody, MountedMarker, family
from tagmetry.twin.scenes.path import Path, Still
from tagmetry.twin.scenes.sheet import INK, PAPER, Dot, Print, Sheet

_NOWHERE = Still(RigidTransform.identity())


@dataclass(frozen=True, eq=False)
class Thing:
    """A rigid thing made of sheets.

    Attributes:
        name: What it is called.
        sheets: What it looks like; of sheets in one plane, a later one lies on an earlier one.
        markers: The markers on it, whose truth is wanted.
        board: The board that it is, whose corners' truth is wanted.
        path: Where it is, T_world_thing.
        scenery: It is only there to be looked at: its edges seen from the side may be off by a few
            thousandths of a pixel, which saves much time.
    """

    name: str
    sheets: tuple[Sheet, ...]
    markers: tuple[MountedMarker, ...] = ()
    board: Board | None = None
    path: Path = field(default=_NOWHERE)
    scenery: bool = False


def marker_thing(
    markers: Sequence[MountedMarker],
    path: Path = _NOWHERE,
    *,
    name: str = "markers",
    quiet_cells: float = 1.0,
    paper: float = PAPER,
    ink: float = INK,
) -> Thing:
    """Return markers, each on its own paper that is wider by its quiet zone."""
    sheets = tuple(marker_sheet(marker, quiet_cells, paper, ink) for marker in markers)
    return Thing(name, sheets, tuple(markers), path=path)


def marker_sheet(
    marker: MountedMarker, quiet_cells: float = 1.0, paper: float = PAPER, ink: float = INK
) -> Sheet:
    """Return a marker on a paper that is wider by its quiet zone."""
    printed = _marker_print(marker, (0.0, 0.0))
    side_m = len(printed.ink) * printed.cell_m + 2 * quiet_cells * printed.cell_m
    return Sheet(side_m, side_m, (printed,), marker.T_body_marker, paper, ink)


def board_thing(board: Board, path: Path = _NOWHERE, *, margin_m: float = 0.02) -> Thing:
    """Return a board on a white paper with a margin."""
    prints: tuple[Print | Dot, ...] = (
        *_squares(board.black_squares_m()),
        *_markers(board),
        *_dots(board),
    )
    paper = Sheet(board.width_m + 2 * margin_m, board.height_m + 2 * margin_m, prints)
    return Thing("board", (paper,), board.markers(), board, path)


def body_thing(body: MarkerBody, path: Path = _NOWHERE, *, quiet_cells: float = 1.0) -> Thing:
    """Return a body's markers, each on its own paper."""
    return marker_thing(body.markers, path, name=body.name, quiet_cells=quiet_cells)


def surface(
    name: str,
    width_m: float,
    height_m: float,
    path: Path = _NOWHERE,
    *,
    brightness: float = 0.5,
    glow: float = 0.0,
) -> Thing:
    """Return a plain surface, facing its own z."""
    sheet = Sheet(width_m, height_m, paper=brightness, glow=glow)
    return Thing(name, (sheet,), path=path, scenery=True)


def textured(
    name: str,
    texture: Array,
    cell_m: float,
    path: Path = _NOWHERE,
    *,
    light: float = PAPER,
    dark: float = INK,
) -> Thing:
    """Return a surface with a picture in cells, 0 dark to 1 light, shape (rows, columns)."""
    rows, columns = texture.shape
    printed = Print(1.0 - np.asarray(texture, dtype=np.float64), cell_m)
    sheet = Sheet(columns * cell_m, rows * cell_m, (printed,), paper=light, ink=dark)
    return Thing(name, (sheet,), path=path, scenery=True)


def _marker_print(marker: MountedMarker, center_m: tuple[float, float]) -> Print:
    own = family(marker.family)
    picture = own.picture(marker.id).astype(np.float64)
    return Print(1.0 - picture, marker.size_m / own.layout.side_cells, center_m)


def _markers(board: Board) -> list[Print]:
    places = [marker.T_body_marker.translation for marker in board.markers()]
    return [
        _marker_print(marker, (float(x_m), float(y_m)))
        for marker, (x_m, y_m, _) in zip(board.markers(), places, strict=True)
    ]


def _dots(board: Board) -> list[Dot]:
    return [Dot(radius_m, (x_m, y_m)) for x_m, y_m, radius_m in board.circles_m().tolist()]


def _squares(squares_m: Array) -> list[Print]:
    """Return black squares (left, low, side) as one print where they are cells of one grid."""
    if len(squares_m) == 0:
        return []
    side_m = squares_m[0, 2]
    cells = (squares_m[:, :2] - squares_m[:, :2].min(axis=0)) / side_m
    whole = np.rint(cells).astype(int)
    if not (np.allclose(cells, whole, atol=1e-6) and np.allclose(squares_m[:, 2], side_m)):
        return [_square(*square) for square in squares_m.tolist()]
    columns, rows = whole.max(axis=0) + 1
    ink = np.zeros((rows, columns))
    ink[rows - 1 - whole[:, 1], whole[:, 0]] = 1.0
    left_m, low_m = squares_m[:, :2].min(axis=0)
    return [Print(ink, side_m, (left_m + columns * side_m / 2, low_m + rows * side_m / 2))]


def _square(left_m: float, low_m: float, side_m: float) -> Print:
    return Print(np.ones((1, 1)), side_m, (left_m + side_m / 2, low_m + side_m / 2))

"""Tiles in rows and columns on as many pages as they need, with marks for cutting."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tagmetry import __version__
from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm
from tagmetry.files.sheets.footer import footer
from tagmetry.files.sheets.page import Box, Cells, Page, Shape, bar, plain
from tagmetry.files.sheets.paper import PageSetup, Paper
from tagmetry.files.sheets.tile import Tile

_MARK_GAP_M = 0.0005
_MARK_M = 0.0020
_MARK_WIDTH_M = 0.0001
_MARK_REACH_M = _MARK_GAP_M + _MARK_M
_GUTTER_M = 0.0060  # between tiles: the marks of both, and room between them
_ROUNDING_M = 1e-9


@dataclass(frozen=True)
class _Grid:
    """Where tiles may stand on one kind of paper."""

    paper: Paper
    room: Box
    columns: int
    rows: int

    @property
    def places(self) -> int:
        return self.columns * self.rows


def arranged(tiles: Sequence[Tile], caption: str, setup: PageSetup) -> tuple[Page, ...]:
    """Return the pages that hold all tiles.

    Args:
        tiles: All of one size.
        caption: What the pages show.
        setup: Paper, margins and so on.

    Raises:
        InputError: Not even one tile fits a page; the text says which size would.
    """
    papers = setup.paper.turned(setup.orientation)
    grids = [_grid(tiles, caption, paper, setup.margin_m) for paper in papers]
    usable = [grid for grid in grids if grid.places]
    if not usable:
        raise InputError(_too_large(tiles[0], grids))
    best = min(usable, key=lambda grid: -(-len(tiles) // grid.places))
    batches = [tiles[i : i + best.places] for i in range(0, len(tiles), best.places)]
    return tuple(
        Page(best.paper.width_m, best.paper.height_m, shapes, plain(caption))
        for shapes in _drawn(batches, caption, best, setup.margin_m)
    )


def _grid(tiles: Sequence[Tile], caption: str, paper: Paper, margin_m: float) -> _Grid:
    """Return how many tiles stand in a row and a column, no more than are needed."""
    longest_caption = _numbered(caption, len(tiles), len(tiles))
    foot = footer(_printable(paper, margin_m), longest_caption)
    room = foot.room.shrunk(_MARK_REACH_M)
    columns = min(len(tiles), _how_many(tiles[0].width_m, room.width_m))
    needed_rows = -(-len(tiles) // max(columns, 1))
    rows = min(needed_rows, _how_many(tiles[0].height_m, room.height_m))
    return _Grid(paper, room, columns, rows)


def _printable(paper: Paper, margin_m: float) -> Box:
    return Box(0.0, 0.0, paper.width_m, paper.height_m).shrunk(margin_m)


def _how_many(side_m: float, room_m: float) -> int:
    return max(0, int((room_m + _GUTTER_M + _ROUNDING_M) / (side_m + _GUTTER_M)))


def _numbered(caption: str, number: int, count: int) -> str:
    page = f", page {number} of {count}" if count > 1 else ""
    return plain(f"{caption}{page}, tagmetry {__version__}")


def _drawn(
    batches: Sequence[Sequence[Tile]], caption: str, grid: _Grid, margin_m: float
) -> Iterator[tuple[Shape, ...]]:
    """Give what is printed on each page."""
    printable = _printable(grid.paper, margin_m)
    for number, tiles in enumerate(batches, start=1):
        foot = footer(printable, _numbered(caption, number, len(batches)))
        yield (*_tiles_in_place(tiles, grid), *foot.shapes)


def _tiles_in_place(tiles: Sequence[Tile], grid: _Grid) -> Iterator[Shape]:
    for place, tile in enumerate(tiles):
        x_m, y_m = _corner_m(tile, grid, *divmod(place, grid.columns))
        yield from (shape.moved(x_m, y_m) for shape in tile.shapes)
        yield from _cut_marks(Box(x_m, y_m, tile.width_m, tile.height_m))


def _corner_m(tile: Tile, grid: _Grid, row: int, column: int) -> tuple[float, float]:
    """Return the top left corner of a tile; all places together stand in the room's middle."""
    pitch_x_m, pitch_y_m = tile.width_m + _GUTTER_M, tile.height_m + _GUTTER_M
    spare_x_m = grid.room.width_m - (grid.columns * pitch_x_m - _GUTTER_M)
    spare_y_m = grid.room.height_m - (grid.rows * pitch_y_m - _GUTTER_M)
    return (
        grid.room.x_m + spare_x_m / 2 + column * pitch_x_m,
        grid.room.y_m + spare_y_m / 2 + row * pitch_y_m,
    )


def _cut_marks(box: Box) -> list[Cells]:
    """Return lines outside the corners that go on where the sides end."""
    before_x_m, after_x_m = box.x_m - _MARK_REACH_M, box.right_m + _MARK_GAP_M
    before_y_m, after_y_m = box.y_m - _MARK_REACH_M, box.bottom_m + _MARK_GAP_M
    across = [
        bar(x_m, y_m - _MARK_WIDTH_M / 2, _MARK_M, _MARK_WIDTH_M)
        for y_m in (box.y_m, box.bottom_m)
        for x_m in (before_x_m, after_x_m)
    ]
    down = [
        bar(x_m - _MARK_WIDTH_M / 2, y_m, _MARK_WIDTH_M, _MARK_M)
        for x_m in (box.x_m, box.right_m)
        for y_m in (before_y_m, after_y_m)
    ]
    return across + down


def _too_large(tile: Tile, grids: Sequence[_Grid]) -> str:
    rooms = " or ".join(
        f"{format_mm(max(0.0, grid.room.width_m))} x {format_mm(max(0.0, grid.room.height_m))} "
        f"({grid.paper.name})"
        for grid in grids
    )
    largest_m = max(tile.largest_size_m(grid.room.width_m, grid.room.height_m) for grid in grids)
    shown = f"{int(largest_m * 1e4 + 1e-6) / 10:g} mm"
    return (
        f"{tile.size_name} {format_mm(tile.size_m)} needs {format_mm(tile.width_m)} x "
        f"{format_mm(tile.height_m)} with quiet zone and label, the page leaves {rooms}; "
        f"the largest {tile.size_name} that fits is {shown}"
    )

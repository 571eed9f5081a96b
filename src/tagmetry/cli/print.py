"""`tagmetry print`: markers, boards and sheets of markers at true scale."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.files.sheets import Page, PageSetup
    from tagmetry.markers import Board

app = typer.Typer(help="Print markers, boards and sheets at true scale.", no_args_is_help=True)
board_app = typer.Typer(help="Print one board.", no_args_is_help=True)
app.add_typer(board_app, name="board")

_LENGTH = "metres, or with a unit: 120mm, 12cm, 4in"
Family = Annotated[str, typer.Option(help="Marker family, e.g. tag36h11 or 4x4_50.")]
MarkerFamily = Annotated[
    str, typer.Option("--family", help="Marker family, e.g. tag36h11, or a dictionary file.")
]
Size = Annotated[str, typer.Option(help=f"Side of a marker's black square, {_LENGTH}.")]
Square = Annotated[str, typer.Option(help=f"Side of a square, {_LENGTH}.")]
Columns = Annotated[int, typer.Option(help="How many stand in a row.")]
Rows = Annotated[int, typer.Option(help="How many rows there are.")]
FirstId = Annotated[int, typer.Option(help="Id of the first marker.")]
Out = Annotated[Path, typer.Option(help="File to write: .pdf, .svg or .png.")]
PaperSize = Annotated[str, typer.Option(help="a0 to a6, letter, legal, tabloid, or 210x297mm.")]
Orientation = Annotated[str, typer.Option(help="portrait, landscape, or auto.")]
Margin = Annotated[str, typer.Option(help="White along the paper's edges.")]
Quiet = Annotated[int, typer.Option(help="Width of the quiet zone in cells.")]
Inverted = Annotated[bool, typer.Option("--inverted", help="Print white on black.")]
Dpi = Annotated[float, typer.Option(help="Resolution of a .png.")]


@app.command()
def marker(  # noqa: PLR0913 (each argument is an option)
    *,
    marker_id: Annotated[int, typer.Option("--id", help="Id of the marker.")],
    size: Size,
    out: Out,
    family: MarkerFamily = "tag36h11",
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print one marker."""
    from tagmetry.files import resolve_family
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.files.sheets import marker_page

    setup = _setup(paper, orientation, margin, quiet, inverted)
    page = marker_page(resolve_family(family), marker_id, parse_length_m(size), setup)
    _write([page], out, dpi)


@app.command()
def sheet(  # noqa: PLR0913 (each argument is an option)
    *,
    ids: Annotated[str, typer.Option(help="Ids to print: 0-23,30, or all.")],
    size: Size,
    out: Out,
    family: MarkerFamily = "tag36h11",
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print many markers to cut out, on as many pages as they need."""
    from tagmetry.files import resolve_family
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.files.sheets import parse_ids, sheet_pages

    setup = _setup(paper, orientation, margin, quiet, inverted)
    wanted = resolve_family(family)
    _write(sheet_pages(wanted, parse_ids(ids, wanted), parse_length_m(size), setup), out, dpi)


@board_app.command()
def grid(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Columns,
    rows: Rows,
    size: Size,
    gap: Annotated[str, typer.Option(help=f"White between neighbours, {_LENGTH}.")],
    out: Out,
    family: Family = "tag36h11",
    first_id: FirstId = 0,
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print markers in rows and columns."""
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.markers import GridBoard

    size_m, gap_m = parse_length_m(size), parse_length_m(gap)
    board = GridBoard(columns, rows, size_m, gap_m, family, first_id)
    _write_board(board, _setup(paper, orientation, margin, quiet, inverted), out, dpi)


@board_app.command()
def aprilgrid(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Columns,
    rows: Rows,
    size: Size,
    out: Out,
    spacing: Annotated[float, typer.Option(help="White between tags as a share of size.")] = 0.3,
    family: Family = "tag36h11_border2",
    first_id: FirstId = 0,
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print Kalibr's AprilGrid."""
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.markers import AprilGrid

    board = AprilGrid(columns, rows, parse_length_m(size), spacing, family, first_id)
    _write_board(board, _setup(paper, orientation, margin, quiet, inverted), out, dpi)


@board_app.command()
def chessboard(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Annotated[int, typer.Option(help="Inner corners in a row.")],
    rows: Annotated[int, typer.Option(help="Rows of inner corners.")],
    square: Square,
    out: Out,
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print a chessboard, counted by its inner corners."""
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.markers import Chessboard

    board = Chessboard(columns, rows, parse_length_m(square))
    _write_board(board, _setup(paper, orientation, margin, quiet, inverted), out, dpi)


@board_app.command()
def charuco(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Columns,
    rows: Rows,
    square: Square,
    size: Size,
    out: Out,
    family: Family = "5x5_250",
    first_id: FirstId = 0,
    legacy: Annotated[
        bool, typer.Option("--legacy", help="The layout of OpenCV before 4.6.")
    ] = False,
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print a ChArUco board, counted by its squares."""
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.markers import CharucoBoard

    square_m, size_m = parse_length_m(square), parse_length_m(size)
    board = CharucoBoard(columns, rows, square_m, size_m, family, first_id, legacy)
    _write_board(board, _setup(paper, orientation, margin, quiet, inverted), out, dpi)


@board_app.command()
def circles(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Annotated[int, typer.Option(help="Discs in a row.")],
    rows: Annotated[int, typer.Option(help="Rows of discs.")],
    pitch: Annotated[str, typer.Option(help=f"From one row to the next, {_LENGTH}.")],
    diameter: Annotated[str, typer.Option(help=f"Diameter of a disc, {_LENGTH}.")],
    out: Out,
    asymmetric: Annotated[
        bool,
        typer.Option(
            "--asymmetric", help="Every second row moved by a pitch, discs two pitches apart."
        ),
    ] = False,
    paper: PaperSize = "a4",
    orientation: Orientation = "auto",
    margin: Margin = "10mm",
    quiet: Quiet = 1,
    inverted: Inverted = False,
    dpi: Dpi = 600,
) -> None:
    """Print discs in rows and columns, straight or staggered."""
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.markers import CircleGrid

    pitch_m, diameter_m = parse_length_m(pitch), parse_length_m(diameter)
    board = CircleGrid(columns, rows, pitch_m, diameter_m, asymmetric)
    _write_board(board, _setup(paper, orientation, margin, quiet, inverted), out, dpi)


def _setup(
    paper: str, orientation: str, margin: str, quiet_cells: int, inverted: bool
) -> "PageSetup":
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.files.sheets import PageSetup, parse_orientation, parse_paper

    turned, margin_m = parse_orientation(orientation), parse_length_m(margin)
    return PageSetup(parse_paper(paper), turned, margin_m, quiet_cells, inverted)


def _write_board(board: "Board", setup: "PageSetup", out: Path, dpi: float) -> None:
    from tagmetry.files.sheets import board_page

    _write([board_page(board, setup)], out, dpi)


def _write(pages: Sequence["Page"], out: Path, dpi: float) -> None:
    from tagmetry.files.sheets import write_pages

    paths = write_pages(pages, out, dpi)
    where = str(paths[0]) if len(paths) == 1 else f"{paths[0]} to {paths[-1].name}"
    count = "1 page" if len(pages) == 1 else f"{len(pages)} pages"
    typer.echo(f"wrote {count}: {pages[0].title} -> {where}")

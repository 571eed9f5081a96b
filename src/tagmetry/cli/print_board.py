"""`tagmetry print board`: boards at true scale, one command each."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.print_options import (
    LENGTH,
    Dpi,
    Inverted,
    Margin,
    Orientation,
    Out,
    PaperSize,
    Quiet,
    Size,
    page_setup,
    write,
)

if TYPE_CHECKING:
    from tagmetry.files.sheets import PageSetup
    from tagmetry.markers import Board

app = typer.Typer(help="Print one board.", no_args_is_help=True)

Family = Annotated[str, typer.Option(help="Marker family, e.g. tag36h11 or 4x4_50.")]
Square = Annotated[str, typer.Option(help=f"Side of a square, {LENGTH}.")]
Columns = Annotated[int, typer.Option(help="How many stand in a row.")]
Rows = Annotated[int, typer.Option(help="How many rows there are.")]
FirstId = Annotated[int, typer.Option(help="Id of the first marker.")]


@app.command()
def grid(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Columns,
    rows: Rows,
    size: Size,
    gap: Annotated[str, typer.Option(help=f"White between neighbours, {LENGTH}.")],
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
    _write_board(board, page_setup(paper, orientation, margin, quiet, inverted), out, dpi)


@app.command()
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
    _write_board(board, page_setup(paper, orientation, margin, quiet, inverted), out, dpi)


@app.command()
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
    _write_board(board, page_setup(paper, orientation, margin, quiet, inverted), out, dpi)


@app.command()
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
    _write_board(board, page_setup(paper, orientation, margin, quiet, inverted), out, dpi)


@app.command()
def circles(  # noqa: PLR0913 (each argument is an option)
    *,
    columns: Annotated[int, typer.Option(help="Discs in a row.")],
    rows: Annotated[int, typer.Option(help="Rows of discs.")],
    pitch: Annotated[str, typer.Option(help=f"From one row to the next, {LENGTH}.")],
    diameter: Annotated[str, typer.Option(help=f"Diameter of a disc, {LENGTH}.")],
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
    _write_board(board, page_setup(paper, orientation, margin, quiet, inverted), out, dpi)


def _write_board(board: "Board", setup: "PageSetup", out: Path, dpi: float) -> None:
    from tagmetry.files.sheets import board_page

    write([board_page(board, setup)], out, dpi)

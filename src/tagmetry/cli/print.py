"""`tagmetry print`: markers, boards and sheets of markers at true scale."""

from typing import Annotated

import typer

from tagmetry.cli import print_board
from tagmetry.cli.print_options import (
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

app = typer.Typer(help="Print markers, boards and sheets at true scale.", no_args_is_help=True)
app.add_typer(print_board.app, name="board")

MarkerFamily = Annotated[
    str, typer.Option("--family", help="Marker family, e.g. tag36h11, or a dictionary file.")
]


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

    setup = page_setup(paper, orientation, margin, quiet, inverted)
    page = marker_page(resolve_family(family), marker_id, parse_length_m(size), setup)
    write([page], out, dpi)


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

    setup = page_setup(paper, orientation, margin, quiet, inverted)
    wanted = resolve_family(family)
    write(sheet_pages(wanted, parse_ids(ids, wanted), parse_length_m(size), setup), out, dpi)

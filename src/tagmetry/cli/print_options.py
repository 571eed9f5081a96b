"""What all commands of `tagmetry print` share: the paper, and the files that are written."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.files.sheets import Page, PageSetup

LENGTH = "metres, or with a unit: 120mm, 12cm, 4in"
Size = Annotated[str, typer.Option(help=f"Side of a marker's black square, {LENGTH}.")]
Out = Annotated[Path, typer.Option(help="File to write: .pdf, .svg or .png.")]
PaperSize = Annotated[str, typer.Option(help="a0 to a6, letter, legal, tabloid, or 210x297mm.")]
Orientation = Annotated[str, typer.Option(help="portrait, landscape, or auto.")]
Margin = Annotated[str, typer.Option(help="White along the paper's edges.")]
Quiet = Annotated[int, typer.Option(help="Width of the quiet zone in cells.")]
Inverted = Annotated[bool, typer.Option("--inverted", help="Print white on black.")]
Dpi = Annotated[float, typer.Option(help="Resolution of a .png.")]


def page_setup(
    paper: str, orientation: str, margin: str, quiet_cells: int, inverted: bool
) -> "PageSetup":
    """Return the paper as the options ask for it."""
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.files.sheets import PageSetup, parse_orientation, parse_paper

    turned, margin_m = parse_orientation(orientation), parse_length_m(margin)
    return PageSetup(parse_paper(paper), turned, margin_m, quiet_cells, inverted)


def write(pages: Sequence["Page"], out: Path, dpi: float) -> None:
    """Write pages, and say what was written where."""
    from tagmetry.files.sheets import write_pages

    paths = write_pages(pages, out, dpi)
    where = str(paths[0]) if len(paths) == 1 else f"{paths[0]} to {paths[-1].name}"
    count = "1 page" if len(pages) == 1 else f"{len(pages)} pages"
    typer.echo(f"wrote {count}: {pages[0].title} -> {where}")

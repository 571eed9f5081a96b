"""What `tagmetry bench` says when it is done: tables, notes, and on request a picture."""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.lab.bench import Results

_WIDTH = 100  # of the tables where no terminal says another


def check_outputs(json: Path | None, picture: Path | None) -> None:
    """Raise InputError when a file could not be written in the end."""
    from importlib.util import find_spec

    from tagmetry.cli.options import check_png
    from tagmetry.errors import MissingExtraError
    from tagmetry.files.atomic import check_destinations

    check_destinations(json)
    check_png(picture)
    if picture is not None and find_spec("matplotlib") is None:
        raise MissingExtraError("a picture of the results", "report")


def tell(results: "Results", former: "Results | None", picture: Path | None) -> None:
    """Print the results, beside those of a former run where there is one; draw the picture."""
    import sys

    from rich.console import Console

    from tagmetry.lab.bench.compare import compared
    from tagmetry.lab.bench.picture import save_picture
    from tagmetry.lab.bench.table import change_table, failures, tables
    from tagmetry.lab.engines import missing

    console = Console(width=None if sys.stdout.isatty() else _WIDTH, highlight=False)
    for table in tables(results):
        console.print(table, "")
    for line in failures(results):
        console.print(line)
    if missing():
        console.print(
            f"not installed: {', '.join(missing())} (pip install 'tagmetry[bench]')", markup=False
        )
    if former is not None:
        comparison = compared(results, former)
        console.print(change_table(comparison), *comparison.notes, sep="\n")
    if picture is not None:
        save_picture(results, picture)

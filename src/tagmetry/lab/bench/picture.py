"""The results drawn: time, recall and error over number and size, and images a second by robots."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.files.atomic import write_atomically
from tagmetry.lab.bench.panels import PANELS, available
from tagmetry.lab.bench.results import Results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PANEL_INCH = (5.0, 3.8)
_LEGEND_INCH = 0.5
_DPI = 100


def save_picture(results: Results, path: Path) -> None:
    """Draw all that the results have, into one PNG.

    Raises:
        InputError: There is nothing to draw, or the file is no PNG or cannot be written.
        MissingExtraError: matplotlib is not installed.
    """
    if path.suffix.lower() != ".png":
        raise InputError(f"expected a picture's name that ends in .png, found {path}")
    panels = available(results)
    if not panels:
        raise InputError("nothing was found that could be drawn")
    buffer = BytesIO()
    figure_of(results, panels).savefig(buffer, format="png", dpi=_DPI)
    write_atomically(path, buffer.getvalue())


def figure_of(results: Results, panels: Sequence[str]) -> "Figure":
    """Return a figure with some panels, up to three in a row."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise MissingExtraError("the picture", "report") from error
    columns = min(3, len(panels))
    rows = -(-len(panels) // columns)
    width, height = _PANEL_INCH
    figure = Figure(figsize=(columns * width, rows * height + _LEGEND_INCH), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes, name in zip(grid, panels, strict=False):
        PANELS[name](axes, results)
    for axes in grid[len(panels) :]:
        axes.axis("off")
    _legend(figure)
    return figure


def _legend(figure: "Figure") -> None:
    """Name every curve once, below all panels."""
    named = {
        label: handle
        for axes in figure.axes
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(
        named.values(), named.keys(), loc="outside lower center", ncols=6, frameon=False, fontsize=9
    )

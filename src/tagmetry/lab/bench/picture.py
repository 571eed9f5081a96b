"""The results drawn: time, recall and error over number and size, and images a second by robots."""

from collections.abc import Callable, Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.files.atomic import write_atomically
from tagmetry.lab.bench import seed
from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.setup import FULL_HD, SETUPS, Setup
from tagmetry.lab.engines import OURS, TRACKER
from tagmetry.lab.engines.palette import COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

_PANEL_INCH = (5.0, 3.8)
_LEGEND_INCH = 0.5
_DPI = 100
_BOUND = "Cramér-Rao bound"

Value = Callable[[Row], float | None]
Abscissa = Callable[[Setup], float]


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


def available(results: Results) -> list[str]:
    """Return the names of the panels that the results have points for."""
    cases = {row.case for row in results.rows}
    curves = [name for name, setups in _NEEDED.items() if len(cases & _names(setups)) > 1]
    return [*(["trade"] if _weighed(results) else []), *curves]


def _time_and_error(axes: "Axes", results: Results) -> None:
    """Draw every engine's time and error on one case: the nearer to the lower left the better."""
    rows = _weighed(results)
    for row in rows:
        at = np.array([row.p50_ms, row.corner_rms_px], dtype=np.float64)
        colour = COLOURS.get(row.engine, "0.5")
        axes.plot(*at, "o", ms=8, color=colour, label=row.engine)
    if rows[0].bound_px is not None:
        axes.axhline(rows[0].bound_px, color="k", ls="--", lw=1, label=_BOUND)
    _dress(axes, f"Time and corners of {rows[0].case}", "ms, one thread", "rms, px")
    _both_logarithmic(axes)


def _weighed(results: Results) -> list[Row]:
    """Return the rows of the standard case, or else of the first, that have time and error."""
    rows = [row for row in results.rows if row.p50_ms and row.corner_rms_px]
    cases = dict.fromkeys(row.case for row in rows)
    case = SETUPS[0].name if SETUPS[0].name in cases else next(iter(cases), None)
    return [row for row in rows if row.case == case and row.threads == rows[0].threads]


def _names(setups: Sequence[Setup]) -> set[str]:
    return {setup.name for setup in setups}


def _time_by_number(axes: "Axes", results: Results) -> None:
    _curves(axes, results, _COUNTS, lambda setup: setup.count, lambda row: row.p50_ms)
    _dress(axes, "Time of a full HD image", "markers", "ms, one thread")
    _both_logarithmic(axes)


def _time_by_noise(axes: "Axes", results: Results) -> None:
    _curves(axes, results, _NOISES, lambda setup: setup.noise, lambda row: row.p50_ms)
    _dress(axes, "Time of 24 markers in noise", "noise, grey values", "ms, one thread")
    axes.set_yscale("log")
    _plain_numbers(axes.yaxis)


def _error_by_side(axes: "Axes", results: Results) -> None:
    _curves(axes, results, _SIDES, lambda setup: setup.side_px, lambda row: row.corner_rms_px)
    _bound(axes, results, _SIDES)
    _dress(axes, "Corners, linear camera", "side, px", "rms, px")
    _both_logarithmic(axes)


def _error_by_side_with_gamma(axes: "Axes", results: Results) -> None:
    _curves(axes, results, _GAMMAS, lambda setup: setup.side_px, lambda row: row.corner_rms_px)
    _bound(axes, results, _GAMMAS)
    _dress(axes, "Corners, gamma 2.2", "side, px", "rms, px")
    _both_logarithmic(axes)


def _recall_by_side(axes: "Axes", results: Results) -> None:
    _curves(axes, results, _SIDES, lambda setup: setup.side_px, lambda row: row.recall)
    _dress(axes, "Markers found", "side, px", "share")
    axes.set_ylim(-0.05, 1.05)
    _x_logarithmic(axes)


def _images_by_robots(axes: "Axes", results: Results) -> None:
    def images_per_s(row: Row) -> float | None:
        return 1000 / row.p50_ms if row.p50_ms else None

    for engine, setups in ((OURS, _COUNTS), (TRACKER, _FILMS)):
        _curve(axes, results, engine, setups, lambda setup: setup.count, images_per_s)
    axes.plot(seed.ROBOTS, seed.IMAGES_PER_S, "ks--", label="seed 001, figure 10")
    axes.axhline(seed.CAMERA_HZ, color="0.6", lw=0.8)
    axes.annotate("its camera's limit", (1, seed.CAMERA_HZ), fontsize=7, va="bottom")
    axes.axhline(seed.LEAST_IMAGES_PER_S, color="0.6", lw=0.8, ls=":")
    axes.annotate("its slowest", (1, seed.LEAST_IMAGES_PER_S), fontsize=7, va="bottom")
    _dress(axes, "Full HD images in a second", "robots", "1/s, one thread")
    _both_logarithmic(axes)


def _curves(
    axes: "Axes", results: Results, setups: Sequence[Setup], abscissa: Abscissa, value: Value
) -> None:
    for engine in dict.fromkeys(row.engine for row in results.rows):
        _curve(axes, results, engine, setups, abscissa, value)


def _curve(
    axes: "Axes",
    results: Results,
    engine: str,
    setups: Sequence[Setup],
    abscissa: Abscissa,
    value: Value,
) -> None:
    """Draw one engine; a former name that is unknown now is grey."""
    points = [
        (abscissa(setup), y)
        for setup in setups
        if (row := results.of(setup.name, engine, 1)) is not None and (y := value(row)) is not None
    ]
    if points:
        width = 2.2 if engine.startswith(OURS) else 1.1
        colour = COLOURS.get(engine, "0.5")
        axes.plot(*zip(*points, strict=True), "o-", ms=4, lw=width, color=colour, label=engine)


def _bound(axes: "Axes", results: Results, setups: Sequence[Setup]) -> None:
    """Draw the Cramer-Rao bound."""
    points = {
        setup.side_px: row.bound_px
        for row in results.rows
        for setup in setups
        if row.case == setup.name and row.bound_px is not None
    }
    axes.plot(*zip(*sorted(points.items()), strict=True), "k--", lw=1, label=_BOUND)


def _dress(axes: "Axes", title: str, abscissa: str, ordinate: str) -> None:
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(abscissa)
    axes.set_ylabel(ordinate)
    axes.grid(visible=True, which="both", alpha=0.2)


def _both_logarithmic(axes: "Axes") -> None:
    axes.set_yscale("log")
    _plain_numbers(axes.yaxis)
    _x_logarithmic(axes)


def _x_logarithmic(axes: "Axes") -> None:
    axes.set_xscale("log")
    _plain_numbers(axes.xaxis)


def _plain_numbers(axis: "Axis") -> None:
    """Write a logarithmic axis' numbers as people do: 0.5, 1, 2, 50."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_formatter(NullFormatter())


def _like(names: Sequence[str], key: Abscissa) -> list[Setup]:
    """Return setups by the beginnings of their names, in the order of the abscissa."""
    found = [s for s in SETUPS if s.name.startswith(tuple(names)) and s.size_px == FULL_HD]
    return sorted(found, key=key)


_COUNTS = _like(["count-"], lambda setup: setup.count)
_SIDES = _like(["side-", "count-24"], lambda setup: setup.side_px)
_GAMMAS = _like(["gamma-"], lambda setup: setup.side_px)
_NOISES = [
    setup
    for setup in _like(["noise-", "count-24"], lambda setup: setup.noise)
    if setup.side_px == SETUPS[0].side_px
]
_FILMS = _like(["film-"], lambda setup: setup.count)

PANELS: dict[str, Callable[["Axes", Results], None]] = {
    "trade": _time_and_error,
    "time": _time_by_number,
    "noise": _time_by_noise,
    "corners": _error_by_side,
    "gamma": _error_by_side_with_gamma,
    "recall": _recall_by_side,
    "robots": _images_by_robots,
}
_NEEDED = {
    "time": _COUNTS,
    "noise": _NOISES,
    "corners": _SIDES,
    "gamma": _GAMMAS,
    "recall": _SIDES,
    "robots": _COUNTS,
}

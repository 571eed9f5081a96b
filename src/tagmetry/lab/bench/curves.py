"""Curves of engines over what a case's setup varies, and the bound."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.setup import Setup
from tagmetry.lab.engines import OURS
from tagmetry.lab.engines.palette import COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

BOUND = "Cramér-Rao bound"

Value = Callable[[Row], float | None]
Abscissa = Callable[[Setup], float]


def draw_curves(
    axes: "Axes", results: Results, setups: Sequence[Setup], abscissa: Abscissa, value: Value
) -> None:
    """Draw every engine."""
    for engine in dict.fromkeys(row.engine for row in results.rows):
        draw_curve(axes, results, engine, setups, abscissa, value)


def draw_curve(
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


def draw_bound(axes: "Axes", results: Results, setups: Sequence[Setup]) -> None:
    """Draw the Cramer-Rao bound."""
    points = {
        setup.side_px: row.bound_px
        for row in results.rows
        for setup in setups
        if row.case == setup.name and row.bound_px is not None
    }
    axes.plot(*zip(*sorted(points.items()), strict=True), "k--", lw=1, label=BOUND)

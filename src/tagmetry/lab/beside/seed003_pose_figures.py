"""Figures 10 to 23 of seed 003 with ours in them: errors by position, and regression lines."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.beside.readings import Readings, printed
from tagmetry.lab.published.seed003 import PositionTable
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import BLUE, GOLD, RED, blank

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_NAMES = ("published", "its steps on the twin", "ours")
_COLORS = (RED, GOLD, BLUE)
_MARKS = ("s", "^", "o")
_LEAST = 1e-4  # cm and %: where a logarithmic axis ends


def error_figure(
    table: PositionTable, place: str, ours: Readings, its_steps: Readings
) -> ReportFigure:
    """Return absolute and relative errors by position; exact zeros stand at the lower edge."""
    each = (printed(table), its_steps, ours)

    def draw() -> "Figure":
        figure, _ = blank(7.0, 3.4)
        figure.clear()
        for axes, unit in zip(figure.subplots(1, 2), ("cm", "%"), strict=True):
            for name, color, mark, one in zip(_NAMES, _COLORS, _MARKS, each, strict=True):
                errors = one.absolute_cm if unit == "cm" else one.relative_percent
                mean = np.maximum(errors.mean(axis=0), _LEAST)
                axes.semilogy(one.actual_cm, mean, mark, color=color, label=name, ms=5)
            axes.set_xlabel("actual position, cm")
            axes.set_ylabel("absolute error, cm" if unit == "cm" else "relative error, %")
            axes.set_ylim(_LEAST * 0.8)
        figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3)
        return figure

    number = (table.figures or [0])[0]
    return ReportFigure(
        f"seed003_figure{number}",
        f"Figure {number}: errors, {place}",
        f"Mean absolute error: published {table.mean[0]:g} cm, ours "
        f"{ours.absolute_cm.mean():.4f} cm. The published errors are rounded to 0.1 cm.",
        draw,
    )


def regression_figure(
    table: PositionTable, place: str, ours: Readings, its_steps: Readings
) -> ReportFigure:
    """Return what is read less what is true, with the regression lines.

    The paper plots the readings themselves, in which no error can be seen.
    """
    each = (printed(table), its_steps, ours)

    def draw() -> "Figure":
        figure, axes = blank(7.0, 3.4)
        for name, color, mark, one in zip(_NAMES, _COLORS, _MARKS, each, strict=True):
            line, ends = one.line, np.array([one.actual_cm.min(), one.actual_cm.max()])
            axes.plot(
                one.actual_cm, (one.measured_cm - one.actual_cm).mean(axis=0), mark, color=color
            )
            told = f"{name}: {line.constant_cm:.3f} + {line.slope:.4f} X"
            axes.plot(
                ends, line.constant_cm + (line.slope - 1) * ends, color=color, lw=1, label=told
            )
        axes.set_xlabel("actual position, cm")
        axes.set_ylabel("reading less actual, cm")
        axes.legend(fontsize=8)
        return figure

    number = (table.figures or [0, 0])[1]
    return ReportFigure(
        f"seed003_figure{number}",
        f"Figure {number}: regression, {place}",
        f"Slope of the readings: published {printed(table).line.slope:.3f}, ours "
        f"{ours.line.slope:.5f}; 1 is exact.",
        draw,
    )

"""Positions along x, y and z beside tables 7 to 15 of seed 003, row by row."""

from collections.abc import Iterator, Sequence

import numpy as np

from tagmetry.lab.beside.readings import Readings, printed, readings_of
from tagmetry.lab.beside.seed003_pose_figures import error_figure, regression_figure
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed003 import PositionTable, seed003
from tagmetry.lab.rows import Position
from tagmetry.record.report import Cell, ReportFigure, ReportTable

_LEAST_PERCENT = 99.8
_HALF_DIGIT = 1e-6
_SETUP = (
    "The paper does not tell its marker's side; 100 mm is taken. The marker leans by up to 2 "
    "degrees, at random. Pictures: 640x480, 0.6 px of blur, noise of 2 grey values."
)
_CAUSES = (
    "A wrong size scales every coordinate alike, a wrong focal length only z. The published slopes "
    "grow with the distance in x, y and z together, which no constant mistake does. The paper's "
    "own steps, on exact pictures, give errors in z of the order that it prints: they come from "
    "the corners, which its program leaves unrefined."
)


def conclude(rows: Sequence[Position]) -> Conclusions:
    """Return accuracy by axis and distance, every row, what mistakes do, and figures 10 to 23."""
    tables = seed003().positions
    return Conclusions(
        checks=tuple(check for table in tables for check in _checks(rows, table)),
        tables=(
            _accuracies(rows),
            _mistakes(rows),
            *(_row_by_row(rows, table) for table in tables),
        ),
        figures=tuple(figure for table in tables for figure in _figures(rows, table)),
        remarks=(_SETUP, _CAUSES, *seed003().remarks[4:]),
    )


def place_of(table: PositionTable) -> str:
    """Return what a table measures, in words."""
    return f"{table.axis} at {table.distance_cm} cm"


def _checks(rows: Sequence[Position], table: PositionTable) -> Iterator[Check]:
    ours = readings_of(rows, table, "tagmetry")
    least = float(ours.accuracies_percent.min())
    repeats = len(ours.measured_cm)
    yield Check(
        f"accuracy of {place_of(table)}",
        f"at least {_LEAST_PERCENT} %",
        f"{ours.accuracies_percent.mean():.3f} % (worst of {repeats}: {least:.3f} %)",
        least >= _LEAST_PERCENT,
    )
    worse = sum(verdict == "worse" for verdict in _verdicts(ours, table))
    yield Check(
        f"rows of table {table.table}, read to 0.1 cm as the paper does",
        "none worse than published",
        f"{worse} of {len(table.rows)} worse",
        worse == 0,
    )


def _verdicts(ours: Readings, table: PositionTable) -> list[str]:
    """Return for each row whether ours is better than the printed one, at its resolution."""
    published_cm = printed(table).absolute_cm[0]
    return [
        "equal" if abs(own - other) < _HALF_DIGIT else "better" if own < other else "worse"
        for own, other in zip(ours.rounded_cm, published_cm, strict=True)
    ]


def _accuracies(rows: Sequence[Position]) -> ReportTable:
    header = (
        "measured", "published %", "by its own rows %", "its steps on the twin %", "ours %",
        "ours, worst repeat %", "better?",
    )  # fmt: skip
    return ReportTable(
        "seed003_accuracy",
        "Accuracy by axis and distance (equation 6)",
        header,
        tuple(_accuracy_row(rows, table) for table in seed003().positions),
    )


def _accuracy_row(rows: Sequence[Position], table: PositionTable) -> tuple[Cell, ...]:
    ours = readings_of(rows, table, "tagmetry").accuracies_percent
    steps = readings_of(rows, table, "paper").accuracies_percent
    published = table.mean[2]
    is_exact = published == 100  # what was printed is rounded to 0.1 cm: nothing can be better
    verdict = "equal, at its resolution" if is_exact else "yes" if ours.min() > published else "no"
    return (
        place_of(table),
        published,
        float(printed(table).accuracies_percent[0]),
        float(steps.mean()),
        float(ours.mean()),
        float(ours.min()),
        verdict,
    )


def _mistakes(rows: Sequence[Position]) -> ReportTable:
    """Return the regression lines: printed, and ours with one thing wrong at a time."""
    names = list(dict.fromkeys(row.assumed for row in rows if row.method == "tagmetry"))
    return ReportTable(
        "seed003_mistakes",
        "Regression lines, constant (cm) + slope X: which mistake gives errors like the paper's?",
        ("measured", "published", "its steps on the twin", *(f"ours, {name}" for name in names)),
        tuple(_mistake_row(rows, table, names) for table in seed003().positions),
    )


def _mistake_row(
    rows: Sequence[Position], table: PositionTable, names: Sequence[str]
) -> tuple[Cell, ...]:
    lines = [_line_text(readings_of(rows, table, "tagmetry", name)) for name in names]
    steps = _line_text(readings_of(rows, table, "paper"))
    return (place_of(table), _line_text(printed(table)), steps, *lines)


def _line_text(readings: Readings) -> str:
    line = readings.line
    return f"{line.constant_cm:.3f} + {line.slope:.4f} X"


def _row_by_row(rows: Sequence[Position], table: PositionTable) -> ReportTable:
    header = (
        "actual cm", "published cm", "published error cm", "published error %", "ours cm",
        "our error cm", "our error %", "better, read to 0.1 cm?",
    )  # fmt: skip
    return ReportTable(
        f"seed003_table{table.table}",
        f"Table {table.table}: {place_of(table)}",
        header,
        (*_lines(rows, table), _mean_line(rows, table)),
    )


def _lines(rows: Sequence[Position], table: PositionTable) -> Iterator[tuple[Cell, ...]]:
    ours = readings_of(rows, table, "tagmetry")
    for n, (computed_cm, actual_cm, absolute_cm, percent) in enumerate(table.rows):
        yield (
            actual_cm,
            computed_cm,
            absolute_cm,
            percent,
            float(ours.measured_cm[:, n].mean()),
            float(ours.absolute_cm[:, n].mean()),
            float(ours.relative_percent[:, n].mean()),
            _verdicts(ours, table)[n],
        )


def _mean_line(rows: Sequence[Position], table: PositionTable) -> tuple[Cell, ...]:
    ours = readings_of(rows, table, "tagmetry")
    absolute_cm, percent = float(ours.absolute_cm.mean()), float(ours.relative_percent.mean())
    told = "yes" if np.round(absolute_cm, 1) <= table.mean[0] else "no"
    return ("mean", "", table.mean[0], table.mean[1], "", absolute_cm, percent, told)


def _figures(rows: Sequence[Position], table: PositionTable) -> Iterator[ReportFigure]:
    if table.figures is None:
        return
    ours, its_steps = readings_of(rows, table, "tagmetry"), readings_of(rows, table, "paper")
    yield error_figure(table, place_of(table), ours, its_steps)
    yield regression_figure(table, place_of(table), ours, its_steps)

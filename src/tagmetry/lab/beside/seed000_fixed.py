"""Figures 9 and 10 of seed 000 beside ours: how far a marker is read without driving the lens."""

from collections.abc import Sequence

import numpy as np

from tagmetry.lab.beside.lens_figures import depth_error, lens_figure
from tagmetry.lab.beside.lens_readings import LensReadings, result_readings
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.published.seed000 import seed000
from tagmetry.record.report import Cell, ReportFigure, ReportTable

_SETUP = (
    "Figure 9: the calibration is that of focus 40, where autofocus stands for a board at arm's "
    "length, whatever the focus of the picture. Five pictures each; a range counts where all five "
    "were recognized."
)


def conclude(rows: Sequence[LensReading]) -> Conclusions:
    """Return ranges and errors by setting, and both figures."""
    return Conclusions(
        checks=(_least_range(rows),),
        tables=(_table(rows, "9"), _table(rows, "10")),
        figures=(_figure(rows, "9"), _figure(rows, "10")),
        remarks=(_SETUP, *seed000().remarks[3:]),
    )


def _least_range(rows: Sequence[LensReading]) -> Check:
    said = seed000().said("10", "range_m")
    ours = result_readings(rows, figure="10", control="W = 500", method="tagmetry")
    return Check(
        "range of depths with the focus driven at zoom 500",
        f"published {said.at:g} m",
        f"{ours.range_m:.2f} m",
        None,
    )


def _table(rows: Sequence[LensReading], figure: str) -> ReportTable:
    header = (
        "held", "our range m", "its steps' range m", "our worst error %",
        "its steps' worst error %",
    )  # fmt: skip
    said = seed000().said(figure, "range_m")
    parts = result_readings(rows, figure=figure).by("control")
    return ReportTable(
        f"seed000_figure{figure}",
        f"Figure {figure}: published range {said.at:g} m ({said.words})",
        header,
        tuple(_line(name, part) for name, part in parts.items()),
    )


def _line(name: str, part: LensReadings) -> tuple[Cell, ...]:
    both = [part.where(method=method) for method in ("tagmetry", "paper")]
    ranges = [round(one.range_m, 2) for one in both]
    return (name, *ranges, *(_worst_percent(one) for one in both))


def _worst_percent(part: LensReadings) -> float | str:
    errors = np.abs(part.errors_percent)
    return round(float(np.nanmax(errors)), 2) if np.isfinite(errors).any() else "never read"


def _figure(rows: Sequence[LensReading], figure: str) -> ReportFigure:
    titles = {"9": "zoom and focus fixed", "10": "focus driven, zoom fixed"}
    groups = result_readings(rows, figure=figure).by("control")
    return lens_figure(
        figure, titles[figure], groups, "depth_m", depth_error, "error of the depth, %", limit=1.0
    )

"""Figures 11 to 15 of seed 000, and its 64 mm comparison, beside ours; and what must hold."""

from collections.abc import Iterator, Sequence

from tagmetry.lab.beside.lens_figures import (
    depth_error,
    duration,
    lens_figure,
    trace_figure,
    turn_error,
)
from tagmetry.lab.beside.lens_readings import LensReadings, result_readings
from tagmetry.lab.beside.seed000_lens_checks import every_check
from tagmetry.lab.beside.seed000_lens_tables import by_depth, by_turn, large_marker
from tagmetry.lab.conclusions import Conclusions
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.published.seed000 import seed000
from tagmetry.record.report import ReportFigure

_SETUP = (
    "Every run begins with the camera as it is switched on: zoom 100, focus 0, auto modes on. The "
    "marker stands up to 1 % of its depth aside and leans by up to 1 degree. Times are of the "
    "images, at 30 per second, stale ones counted. Its steps wait for each command to show, which "
    "the paper does not tell, and count their own images only. Where the turn is not known to 0.3 "
    "degrees when the measurement has converged, ours is the mean of up to eight images."
)
_FLIPS = (
    "Near the frontal view the two poses of a flat marker can be told apart by perspective only; "
    "where that drowns in noise, the other one wins now and then, and the stated covariance says "
    "so. Such flips are counted beside the errors."
)


def conclude(rows: Sequence[LensReading]) -> Conclusions:
    """Return what must hold, condition by condition, and figures 11 to 15."""
    return Conclusions(
        checks=tuple(every_check(rows)),
        tables=(by_depth(rows), by_turn(rows), large_marker(rows)),
        figures=tuple(_figures(rows)),
        remarks=(_SETUP, _FLIPS, *seed000().remarks),
    )


def _figures(rows: Sequence[LensReading]) -> Iterator[ReportFigure]:
    depths, turns = (result_readings(rows, figure=one) for one in ("11", "14"))
    by_turn = {f"{turn:g} degrees": part for turn, part in depths.by("turn_deg").items()}
    by_depth = {f"{depth:g} m": part for depth, part in turns.by("depth_m").items()}
    error, time = "error of the depth, %", "time to converge, s"
    yield lens_figure("11", "error of the depth", by_turn, "depth_m", depth_error, error, limit=1.0)
    yield lens_figure("12", "time to converge", by_turn, "depth_m", duration, time, limit=0.7)
    traces = LensReadings(tuple(row for row in rows if row.figure == "13" and row.image >= 0))
    if traces.rows:
        yield trace_figure(traces)
    yield lens_figure(
        "14", "error of the turn", by_depth, "turn_deg", turn_error, "error, degrees", limit=1.0,
        bounded=True,
    )  # fmt: skip
    yield lens_figure("15", "time to converge", by_depth, "turn_deg", duration, time, limit=0.6)

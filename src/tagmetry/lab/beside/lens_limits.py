"""The limits of a driven lens: where markers are always found, and their depth is right."""

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.lens_readings import LensReadings, result_readings
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.lens_row import LensReading
from tagmetry.record.report import Cell, ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, GOLD, LIGHT, RED, blank

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PERCENT = 0.3
_RANGE_M = (0.05, 1.05)
_SETUP = (
    f"Good: found in all five repeats, and every depth within {_PERCENT} %. One image each, at the "
    "setting that promises the most."
)


def conclude(rows: Sequence[LensReading]) -> Conclusions:
    """Return the good range of depths and of turns."""
    depths, turns = (result_readings(rows, figure=sweep) for sweep in ("depth", "turn"))
    good_m = _good(depths, "depth_m")
    nearest_m, farthest_m = (good_m[0], good_m[-1]) if good_m else (float("nan"), float("nan"))
    return Conclusions(
        checks=(
            Check(
                "depths at a turn of 30 degrees",
                f"good from {_RANGE_M[0]:g} to {_RANGE_M[1]:g} m",
                f"good from {nearest_m:g} to {farthest_m:g} m",
                bool(nearest_m <= _RANGE_M[0] and farthest_m >= _RANGE_M[1]),
            ),
        ),
        tables=(_table(depths, "depth_m"), *_turn_tables(turns)),
        figures=(_figure(depths, turns),),
        remarks=(_SETUP,),
    )


def _good(readings: LensReadings, field: str) -> list[float]:
    """Return the values around the middle one up to which all readings are good."""
    parts = readings.by(field)
    values = list(parts)
    bad = [value for value, part in parts.items() if not _is_good(part)]
    middle = float(np.median(values)) if values else 0.0
    low = max((one for one in bad if one <= middle), default=-np.inf)
    high = min((one for one in bad if one > middle), default=np.inf)
    return [value for value in values if low < value < high]


def _is_good(part: LensReadings) -> bool:
    return bool(part.found_share == 1 and np.abs(part.errors_percent).max() <= _PERCENT)


def _turn_tables(turns: LensReadings) -> Iterable[ReportTable]:
    return [_table(part, "turn_deg") for part in turns.by("depth_m").values()]


def _table(readings: LensReadings, field: str) -> ReportTable:
    header = (field.replace("_", " "), "found", "worst depth error %", "stated %", "good")
    where = f"_{1000 * readings.rows[0].depth_m:.0f}mm" if field == "turn_deg" else ""
    lines = tuple(_line(value, part) for value, part in readings.by(field).items())
    return ReportTable(f"lens_limits_{field}{where}", f"Limits by {field}{where}", header, lines)


def _line(value: float, part: LensReadings) -> tuple[Cell, ...]:
    errors, stated = np.abs(part.errors_percent), 100 * part.column("sd_m") / part.column("depth_m")
    known = np.isfinite(errors)
    return (
        value,
        f"{int(known.sum())} of {len(known)}",
        round(float(errors[known].max()), 3) if known.any() else "not read",
        round(float(np.median(stated[known])), 3) if known.any() else "",
        "yes" if _is_good(part) else "no",
    )


def _figure(depths: LensReadings, turns: LensReadings) -> ReportFigure:
    def draw() -> "Figure":
        figure, _ = blank(8.8, 3.9)
        figure.clear()
        left, right = figure.subplots(1, 2, sharey=True)
        _worst(left, depths, "depth_m", ("30 degrees", BLUE))
        for color, (depth_m, part) in zip(
            (RED, GOLD, LIGHT), turns.by("depth_m").items(), strict=False
        ):
            _worst(right, part, "turn_deg", (f"{depth_m:g} m", color))
        left.set(
            xscale="log", xlabel="depth, m", ylabel="worst error of the depth, %", yscale="log"
        )
        right.set(xlabel="turn, degrees")
        for axes in (left, right):
            axes.axhline(_PERCENT, ls=":", color="black", lw=1.2)
            axes.legend(*axes.get_legend_handles_labels(), fontsize=8)
        return figure

    told = f"Worst of five; dotted: {_PERCENT} %. A cross: not always found."
    return ReportFigure("lens_limits", "How near, how far, how oblique", told, draw)


def _worst(axes: "Axes", readings: LensReadings, field: str, look: tuple[str, str]) -> None:
    name, color = look
    parts = readings.by(field)
    worst = {x: _worst_percent(part) for x, part in parts.items()}
    always = [x for x, part in parts.items() if part.found_share == 1]
    lost = [x for x in parts if x not in always]
    axes.plot(always, [worst[x] for x in always], "o-", ms=3, color=color, label=name)
    axes.plot(lost, [_PERCENT] * len(lost), "x", ms=7, color=color)


def _worst_percent(part: LensReadings) -> float:
    errors: Array = np.abs(part.errors_percent)
    return float(np.nanmax(errors)) if np.isfinite(errors).any() else float("nan")

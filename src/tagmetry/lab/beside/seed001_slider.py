"""The slider beside figures 11 and 12 of seed 001."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rows import SliderPlace
from tagmetry.record.report import ReportFigure, ReportTable
from tagmetry.record.report.plot import BLUE, RED, blank

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POSITION_M, ANGLE_RAD = 0.001, 0.005  # what must hold
_NAMES = {"tagmetry": "ours", "paper": "its steps"}
_COLORS = {"tagmetry": BLUE, "paper": RED}


def conclude(rows: Sequence[SliderPlace]) -> Conclusions:
    """Return the errors beside the published ones."""
    parts = {method: [row for row in rows if row.method == method] for method in _NAMES}
    return Conclusions(
        checks=tuple(_checks(parts["tagmetry"])),
        tables=(_table(parts),),
        figures=(_figure(parts),),
        remarks=tuple(seed001().remarks[3:4]),
    )


def _checks(rows: Sequence[SliderPlace]) -> list[Check]:
    printed = seed001().slider
    worst_m, worst_rad = _worst(rows, "error_m"), _worst(rows, "error_rad")
    return [
        Check(
            "error of the way, the worst of all images",
            f"at most {1000 * POSITION_M:g} mm (published: {1000 * printed.position_m:g} mm)",
            f"{1000 * worst_m:.3f} mm",
            bool(worst_m <= POSITION_M),
        ),
        Check(
            "error of the turn, the worst of all images",
            f"at most {ANGLE_RAD:g} rad (published: {printed.angle_rad:g} rad)",
            f"{worst_rad:.5f} rad",
            bool(worst_rad <= ANGLE_RAD),
        ),
    ]


def _table(parts: dict[str, list[SliderPlace]]) -> ReportTable:
    printed = seed001().slider
    lines: list[tuple[float | str, ...]] = [
        ("published", 1000 * printed.position_m, "", 1000 * printed.angle_rad, "", "", "")
    ]
    lines += [(_NAMES[method], *_line(rows)) for method, rows in parts.items() if rows]
    header = (
        "", "way: worst mm", "rms mm", "turn: worst mrad", "rms mrad", "stated sd mm, mrad",
        "not found",
    )  # fmt: skip
    title = "Figure 12: a way of 0.81 m and a full turn"
    return ReportTable("seed001_slider", title, header, tuple(lines))


def _line(rows: Sequence[SliderPlace]) -> tuple[float | str, ...]:
    way_mm, turn_mrad = 1000 * _values(rows, "error_m"), 1000 * _values(rows, "error_rad")
    sd_mm, sd_mrad = (1000 * float(_values(rows, name).mean()) for name in ("sd_m", "sd_rad"))
    stated = f"{sd_mm:.3f}, {sd_mrad:.2f}" if np.isfinite(sd_mm) else ""
    return (
        rounded(float(np.nanmax(np.abs(way_mm)))),
        rounded(float(np.sqrt(np.nanmean(way_mm**2)))),
        rounded(float(np.nanmax(np.abs(turn_mrad)))),
        rounded(float(np.sqrt(np.nanmean(turn_mrad**2)))),
        stated,
        int(np.isnan(way_mm).sum()),
    )


def _values(rows: Sequence[SliderPlace], name: str) -> Array:
    return np.array([getattr(row, name) for row in rows])


def _worst(rows: Sequence[SliderPlace], name: str) -> float:
    """Return the largest error; NaN, which holds nothing, where a marker was not found."""
    return float(np.abs(_values(rows, name)).max())


def _figure(parts: dict[str, list[SliderPlace]]) -> ReportFigure:
    def draw() -> "Figure":
        figure, _ = blank(8.4, 5.6)
        figure.clear()
        above, below = figure.subplots(2, 1, sharex=True)
        for method, rows in parts.items():
            first = [row for row in rows if row.repeat == rows[0].repeat]
            times_s = _values(first, "time_s")
            line = {"color": _COLORS[method], "ms": 3, "lw": 1.0}
            above.plot(times_s, 1000 * _values(first, "error_m"), "o-", **line)
            below.plot(
                times_s, 1000 * _values(first, "error_rad"), "o-", label=_NAMES[method], **line
            )
        above.set_ylabel("error of the way, mm")
        below.set(xlabel="time, s", ylabel="error of the turn, mrad")
        below.legend(fontsize=8)
        return figure

    return ReportFigure(
        "seed001_figure12",
        "Figure 12 b and d: errors while the marker moves and turns",
        "Errors of one run; the paper's reach 2 mm and 20 mrad.",
        draw,
    )

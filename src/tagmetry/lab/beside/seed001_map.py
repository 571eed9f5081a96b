"""The error map beside figure 9 of seed 001."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.arena import ErrorMap, GridPlace
from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rows import FloorError
from tagmetry.record.error_map import error_map_figure
from tagmetry.record.report import ReportFigure, ReportTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

CORNER_M, CENTER_M = 0.003, 0.0005  # what must hold
_CENTER_REACH_M = 0.15
_NAMES = {"tagmetry": "ours", "paper": "its steps"}


def conclude(rows: Sequence[FloorError]) -> Conclusions:
    """Return the errors beside the published ones, and the map."""
    parts = {method: [row for row in rows if row.method == method] for method in _NAMES}
    return Conclusions(
        checks=(*_checks(parts["tagmetry"]), _found(parts["tagmetry"])),
        tables=(_table(parts),),
        figures=tuple(_figure(method, part) for method, part in parts.items() if part),
        remarks=(seed001().remarks[2], *seed001().remarks[4:6]),
    )


def _checks(rows: Sequence[FloorError]) -> list[Check]:
    printed = seed001().error_map
    worst_m, near_m = _worst_m(rows), _near_m(rows)
    return [
        Check(
            "radial error, the worst of all 360 markers, corners too",
            f"at most {1000 * CORNER_M:g} mm (published: {1000 * printed.corner_m:g} mm)",
            f"{1000 * worst_m:.2f} mm",
            worst_m <= CORNER_M,
        ),
        Check(
            "radial error of the markers below the camera",
            f"at most {1000 * CENTER_M:g} mm (published: {1000 * printed.center_m:g} mm)",
            f"{1000 * near_m:.3f} mm",
            near_m <= CENTER_M,
        ),
    ]


def _found(rows: Sequence[FloorError]) -> Check:
    missing = int(np.isnan(_errors_m(rows)).sum())
    told = f"{len(rows) - missing} of {len(rows)}"
    return Check("markers found", "all of them", told, missing == 0)


def _table(parts: dict[str, list[FloorError]]) -> ReportTable:
    printed = seed001().error_map
    lines: list[tuple[float | str, ...]] = [
        ("published", 1000 * printed.corner_m, "", "", f"< {1000 * printed.center_m:g}", "", "")
    ]
    for method, rows in parts.items():
        if rows:
            lines.append((_NAMES[method], *_line(rows)))
    header = (
        "", "worst mm", "98 % within mm", "median mm", "worst below the camera mm",
        "not found", "stated sd, rms mm",
    )  # fmt: skip
    title = "Figure 9: radial errors over the floor"
    return ReportTable("seed001_map", title, header, tuple(lines))


def _line(rows: Sequence[FloorError]) -> tuple[float | str, ...]:
    errors_mm = 1000 * _errors_m(rows)
    known = np.isfinite(errors_mm)
    sd_mm = 1000 * np.sqrt(np.mean(np.square([row.sd_m for row in rows])))
    return (
        rounded(float(errors_mm[known].max())),
        rounded(float(np.quantile(errors_mm[known], 0.98))),
        rounded(float(np.median(errors_mm[known]))),
        rounded(1000 * _near_m(rows)),
        int((~known).sum()),
        rounded(float(sd_mm)) if np.isfinite(sd_mm) else "",
    )


def _errors_m(rows: Sequence[FloorError]) -> Array:
    return np.array([np.hypot(row.error_x_m, row.error_y_m) for row in rows])


def _worst_m(rows: Sequence[FloorError]) -> float:
    return float(np.nanmax(_errors_m(rows)))


def _near_m(rows: Sequence[FloorError]) -> float:
    away = np.array([np.hypot(row.x_m, row.y_m) for row in rows])
    return float(np.nanmax(_errors_m(rows)[away <= _CENTER_REACH_M]))


def _figure(method: str, rows: Sequence[FloorError]) -> ReportFigure:
    """Return the map of the first calibration."""
    found = _map([row for row in rows if row.repeat == rows[0].repeat])

    def draw() -> "Figure":
        return error_map_figure(found, f"radial error, {_NAMES[method]}")

    return ReportFigure(
        f"seed001_figure9_{method}",
        f"Figure 9: error map, {_NAMES[method]}",
        f"{len(found.ids)} markers 68 mm apart; the worst is off by {1000 * found.worst_m:.2f} mm.",
        draw,
    )


def _map(rows: Sequence[FloorError]) -> ErrorMap:
    seen = [row for row in rows if np.isfinite(row.error_x_m)]
    true = np.array([(row.x_m, row.y_m) for row in seen])
    errors = np.array([(row.error_x_m, row.error_y_m) for row in seen])
    return ErrorMap(
        np.array([row.id for row in seen]),
        true,
        true + errors,
        np.array([row.sd_m for row in seen]),
        np.zeros(2),
        GridPlace(),
        (),
    )

"""Tables of seed 000's lens that is driven: ours beside the paper's steps."""

from collections.abc import Sequence

import numpy as np

from tagmetry.lab.beside.lens_readings import LensReadings, result_readings, rms
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.published.seed000 import seed000
from tagmetry.record.report import Cell, ReportTable


def by_depth(rows: Sequence[LensReading]) -> ReportTable:
    """Return figures 11 and 12: depth and time over depth."""
    header = (
        "turn degrees", "depth m", "our mean error %", "stated deviation %",
        "its steps' mean error %",
        "our time s", "its steps' time s", "our images to find", "its steps'",
    )  # fmt: skip
    lines = [_depth_line(part) for part in result_readings(rows, figure="11").conditions]
    said = seed000()
    title = (
        f"Figures 11 and 12: published within {said.said('11', 'depth_percent').at:g} % and "
        f"{said.said('12', 'time_s').at:g} s"
    )
    return ReportTable("seed000_figure11", title, header, tuple(lines))


def _depth_line(part: LensReadings) -> tuple[Cell, ...]:
    ours, paper = (part.where(method=method) for method in ("tagmetry", "paper"))
    stated = 100 * ours.column("sd_m") / ours.column("depth_m")
    return (
        part.rows[0].turn_deg,
        part.rows[0].depth_m,
        _shown(ours.mean_percent),
        _shown(float(np.mean(stated))),
        _shown(paper.mean_percent),
        _shown(float(ours.column("simulated_s").mean())),
        _shown(float(paper.column("simulated_s").mean())),
        _shown(float(np.median(ours.column("scanned")))),
        _shown(float(np.median(paper.column("scanned")))),
    )


def by_turn(rows: Sequence[LensReading]) -> ReportTable:
    """Return figures 14 and 15: turn and time over the turn."""
    header = (
        "turn degrees", "depth m", "our rms error degrees", "bound degrees", "stated degrees",
        "flipped", "its steps' rms error degrees", "our time s", "its steps' time s",
        "our images in all",
    )  # fmt: skip
    lines = [_turn_line(part) for part in result_readings(rows, figure="14").conditions]
    title = "Figures 14 and 15: published 1 degree from 20 to 65, 2.5 below 20; within 0.6 s"
    return ReportTable("seed000_figure14", title, header, tuple(lines))


def _turn_line(part: LensReadings) -> tuple[Cell, ...]:
    ours, paper = (part.where(method=method) for method in ("tagmetry", "paper"))
    flipped = ours.flipped
    return (
        part.rows[0].turn_deg,
        part.rows[0].depth_m,
        _shown(rms(ours.errors_deg[~flipped])),
        _shown(rms(ours.column("bound_deg"))),
        _shown(float(np.median(ours.column("sd_deg")))),
        f"{int(flipped.sum())} of {len(flipped)}",
        _shown(rms(paper.errors_deg)),
        _shown(float(ours.column("simulated_s").mean())),
        _shown(float(paper.column("simulated_s").mean())),
        _shown(float(ours.column("images").mean())),
    )


def large_marker(rows: Sequence[LensReading]) -> ReportTable:
    """Return the comparison with a marker of 64 mm."""
    said = seed000()
    header = (
        "depth m", "turn degrees", "our depth error %", "its steps' %", "our turn error degrees",
        "its steps' degrees",
    )  # fmt: skip
    lines = []
    for part in result_readings(rows, figure="64 mm").conditions:
        ours, paper = (part.where(method=method) for method in ("tagmetry", "paper"))
        first = part.rows[0]
        errors = [
            ours.mean_percent,
            paper.mean_percent,
            rms(ours.errors_deg),
            rms(paper.errors_deg),
        ]
        lines.append((first.depth_m, first.turn_deg, *map(_shown, errors)))
    title = (
        f"A 64 mm marker: published {said.said('64 mm', 'depth_percent').at:g} % and "
        f"{said.said('64 mm', 'turn_deg').at:g} degrees from 0.1 to 0.7 m"
    )
    return ReportTable("seed000_64mm", title, header, tuple(lines))


def _shown(value: float) -> float | str:
    return round(value, 4) if np.isfinite(value) else "not read"

"""The tables of a report, those of seed 003 (its tables 3 to 6) among them.

Frames: `board` x right, y up, z out of its face; `camera` x right, y down, z forward.
"""

from collections.abc import Sequence
from pathlib import PurePath

import numpy as np

from tagmetry.calibrate.choice import ModelRow
from tagmetry.calibrate.result import Calibration
from tagmetry.record.calibration_report.facts import CalibrationFacts
from tagmetry.record.report import Cell, ReportTable


def seed_tables(facts: CalibrationFacts) -> tuple[ReportTable, ...]:
    """Return camera matrix, distortion, poses of the views, and errors."""
    calibration = facts.calibration
    return (
        matrix_table(calibration),
        distortion_table(calibration),
        pose_table(calibration),
        error_table(facts),
    )


def matrix_table(calibration: Calibration) -> ReportTable:
    """Return K."""
    rows = tuple(tuple(float(value) for value in row) for row in calibration.camera.matrix)
    return ReportTable(
        "table3_camera_matrix", "Camera matrix", ("column 1 px", "column 2 px", "column 3"), rows
    )


def distortion_table(calibration: Calibration) -> ReportTable:
    """Return the lens' coefficients with their standard deviations."""
    names = calibration.camera.lens.names
    rows = tuple(
        (name, value, honest, formula)
        for name, value, honest, formula in parameter_rows(calibration)
        if name in names
    )
    return ReportTable("table4_distortion", "Distortion", _PARAMETER_HEADER, rows)


def parameter_table(calibration: Calibration) -> ReportTable:
    """Return all intrinsics with their standard deviations."""
    rows = parameter_rows(calibration)
    return ReportTable("camera", "Camera", _PARAMETER_HEADER, rows)


_PARAMETER_HEADER = ("parameter", "value", "standard deviation", "by the usual formula")


def parameter_rows(calibration: Calibration) -> tuple[tuple[str, float, float, float], ...]:
    """Return name, value, honest standard deviation and the formula's of each parameter."""
    camera, formula = calibration.camera, calibration.formula_covariance
    values = (*camera.focal_px, *camera.center_px, *camera.lens.coefficients)
    covariance = formula if camera.covariance is None else camera.covariance
    spreads = (np.sqrt(np.maximum(np.diag(one), 0)) for one in (covariance, formula))
    each = zip(camera.parameter_names, values, *spreads, strict=True)
    return tuple((name, float(v), float(honest), float(usual)) for name, v, honest, usual in each)


def pose_table(calibration: Calibration) -> ReportTable:
    """Return rotation vector and translation of the board in every view."""
    Ts = calibration.Ts_camera_board
    numbers = np.hstack([np.degrees(Ts.rotation.as_rotvec()), np.asarray(Ts.translation) * 1e3])
    names = view_names(calibration)
    rows: list[tuple[Cell, ...]] = [
        (n, *row) for n, row in zip(names, numbers.tolist(), strict=True)
    ]
    header = ("view", "rx deg", "ry deg", "rz deg", "tx mm", "ty mm", "tz mm")
    return ReportTable(
        "table5_views", "Rotation and translation of every view", header, tuple(rows)
    )


def error_table(facts: CalibrationFacts) -> ReportTable:
    """Return every view's errors, then those of all views together."""
    calibration, left_out = facts.calibration, facts.evidence.left_out
    n = len(calibration.views)
    held = left_out.view_px if left_out is not None else np.full(n, np.nan)
    rows: list[tuple[Cell, ...]] = [
        (name, int(kept.sum()), int((~kept).sum()), float(rms), float(out))
        for name, kept, rms, out in zip(
            view_names(calibration), calibration.kept, calibration.view_rms_px, held, strict=True
        )
    ]
    used = sum(int(kept.sum()) for kept in calibration.kept)
    lost = sum(int((~kept).sum()) for kept in calibration.kept)
    all_out = left_out.rms_px if left_out is not None else np.nan
    rows.append(("all", used, lost, calibration.rms_px, float(all_out)))
    rows.append(("all, as seed 003 counts", used, lost, calibration.tutorial_error_px, ""))
    header = ("view", "corners", "left out", "error px", "error when left out px")
    return ReportTable("table6_errors", "Errors", header, tuple(rows))


def choice_table(calibration: Calibration) -> ReportTable | None:
    """Return the lenses that were compared, None where that was not asked for."""
    if calibration.choice is None:
        return None
    rows = tuple(map(_choice_row, calibration.choice.rows))
    header = ("lens", "numbers", "error px", "left-out error px", "BIC", "one to one", "verdict")
    return ReportTable("lens_choice", "Choice of the lens", header, rows)


def _choice_row(row: ModelRow) -> tuple[Cell, ...]:
    errors = (row.rms_px, row.hold_out_px, row.bic, row.monotonic_share)
    return (row.name, row.parameters, *errors, row.verdict)


def pose_error_table(facts: CalibrationFacts) -> ReportTable:
    """Return what the calibration does to a marker's pose at places."""
    rows = tuple(
        (
            one.name,
            one.error.place.distance_m,
            one.error.distance_mm,
            one.error.worst_mm,
            one.error.worst_deg,
            one.error.worst_with_corners_mm,
            one.error.worst_with_corners_deg,
        )
        for one in facts.pose_errors
    )
    header = (
        "place", "distance m", "along the sight mm", "worst mm", "worst deg",
        "with corners mm", "with corners deg",
    )  # fmt: skip
    return ReportTable("pose_errors", "Error of a marker's pose", header, rows)


def view_names(calibration: Calibration) -> tuple[str, ...]:
    """Return a short name for each view: the file's, or its number."""
    return tuple(
        short_name(view.source) or f"view {i + 1}" for i, view in enumerate(calibration.views)
    )


def short_name(source: str) -> str:
    """Return a source without its folders."""
    return PurePath(source).name


def every_table(facts: CalibrationFacts) -> Sequence[ReportTable]:
    """Return all tables."""
    choice = choice_table(facts.calibration)
    others = (parameter_table(facts.calibration), pose_error_table(facts))
    return (*seed_tables(facts), *others, *((choice,) if choice else ()))

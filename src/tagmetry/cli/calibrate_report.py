"""A calibration as lines of text, and as a table for JSON."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.pipeline.calibration import CalibrationRun, RefusedError, advice_line
from tagmetry.record.calibration_report.tables import parameter_rows, short_name, view_names

if TYPE_CHECKING:
    from tagmetry.calibrate.view import RejectedView

_MOST_REJECTED = 12


def run_lines(run: CalibrationRun) -> list[str]:
    """Return views, camera, choice of the lens, verdict and what the board doctor says."""
    return [
        *_view_lines(run),
        *rejected_lines(run.rejected),
        "",
        *_camera_lines(run),
        "",
        *_choice_lines(run),
        *_verdict_lines(run),
        *(f"board: {advice_line(one)}" for one in run.advice),
    ]


def refusal_lines(error: RefusedError) -> list[str]:
    """Return what the pictures show instead: rejected ones, and what the board seems to be."""
    advice = [f"board: {advice_line(one)}" for one in error.advice]
    return [*rejected_lines(error.rejected), *advice]


def rejected_lines(rejected: "tuple[object, ...]") -> list[str]:
    """Return the pictures that were not used, one reason to a line where there are many."""
    from collections import Counter

    from tagmetry.calibrate.view import RejectedView

    views = [one for one in rejected if isinstance(one, RejectedView)]
    if len(views) <= _MOST_REJECTED:
        return [f"  not used: {_named(one)}" for one in views]
    reasons = Counter(view.reason for view in views).most_common(_MOST_REJECTED)
    return [f"  not used: {count} pictures: {reason}" for reason, count in reasons]


def _named(view: "RejectedView") -> str:
    """Return the reason after the picture's name, where it is not in the reason."""
    return f"{short_name(view.source)}: {view.reason}" if view.source else view.reason


def run_table(run: CalibrationRun) -> dict[str, object]:
    """Return a calibration for JSON; what is not known is null."""
    solved, told = run.calibration, run.assessment.verdict
    left_out = told.evidence.left_out
    return {
        "width_px": solved.camera.width_px,
        "height_px": solved.camera.height_px,
        "lens": solved.camera.lens.kind,
        "parameters": [
            {"name": name, "value": value, "sd": sd, "formula_sd": usual}
            for name, value, sd, usual in parameter_rows(solved)
        ],
        "rms_px": solved.rms_px,
        "tutorial_error_px": solved.tutorial_error_px,
        "hold_out_px": None if left_out is None else _number(left_out.rms_px),
        "worst_uncertainty_px": _number(told.evidence.uncertainty.worst_px),
        "middle_uncertainty_px": _number(told.evidence.uncertainty.middle_px),
        "views": [
            {"source": view.source, "corners": int(kept.sum()), "rms_px": float(rms)}
            for view, kept, rms in zip(solved.views, solved.kept, solved.view_rms_px, strict=True)
        ],
        "rejected": [{"source": one.source, "reason": one.reason} for one in run.rejected],
        "choice": _choice_table(run),
        "grade": told.grade,
        "verdict": told.words,
        "fit_for": list(told.fit_for),
        "warnings": list(told.warnings),
        "next_view": told.next_view.text if told.next_view else None,
        "board": [advice_line(one) for one in run.advice],
        "provenance": solved.camera.provenance,
    }


def _view_lines(run: CalibrationRun) -> list[str]:
    solved, left_out = run.calibration, run.assessment.evidence.left_out
    held = left_out.view_px if left_out is not None else np.full(len(solved.views), np.nan)
    lines = [f"{'view':<28} {'corners':>7} {'error px':>9} {'left out':>9}"]
    for name, kept, rms, out in zip(
        view_names(solved), solved.kept, solved.view_rms_px, held, strict=True
    ):
        count = int((~kept).sum())
        lost = f" ({count} corner{'' if count == 1 else 's'} dropped)" if count else ""
        lines.append(f"{name[-28:]:<28} {int(kept.sum()):>7} {rms:>9.3f} {_px(out):>9}{lost}")
    total = _px(left_out.rms_px) if left_out is not None else _px(np.nan)
    count = sum(int(kept.sum()) for kept in solved.kept)
    return [*lines, f"{'all':<28} {count:>7} {solved.rms_px:>9.3f} {total:>9}"]


def _camera_lines(run: CalibrationRun) -> list[str]:
    camera = run.calibration.camera
    lines = [f"{camera.width_px}x{camera.height_px}, {camera.lens.kind} lens"]
    lines += [
        f"  {name:<3} {value:12.6g} ± {sd:<8.2g} (usual formula ± {usual:.2g})"
        for name, value, sd, usual in parameter_rows(run.calibration)
    ]
    return lines


def _choice_lines(run: CalibrationRun) -> list[str]:
    choice = run.calibration.choice
    if choice is None:
        return []
    lines = [f"lens: {choice.reason}"]
    lines += [
        f"  {row.name:<8} {row.parameters:>2} numbers, error {row.rms_px:.3f} px, left out "
        f"{_px(row.hold_out_px)} px, BIC {row.bic:.1f}: {row.verdict}"
        for row in choice.rows
    ]
    return [*lines, ""]


def _verdict_lines(run: CalibrationRun) -> list[str]:
    told = run.assessment.verdict
    lines = [told.words]
    lines += [f"  fit for: {one}" for one in told.fit_for]
    lines += [f"  weak: {one}" for one in told.warnings]
    if told.next_view is not None:
        lines.append(f"next picture: {told.next_view.text}")
    return lines


def _choice_table(run: CalibrationRun) -> dict[str, object] | None:
    choice = run.calibration.choice
    if choice is None:
        return None
    rows = [
        {
            "name": row.name,
            "parameters": row.parameters,
            "rms_px": row.rms_px,
            "hold_out_px": _number(row.hold_out_px),
            "bic": row.bic,
            "monotonic_share": row.monotonic_share,
            "verdict": row.verdict,
        }
        for row in choice.rows
    ]
    return {"chosen": choice.chosen, "reason": choice.reason, "rows": rows}


def _px(value: float) -> str:
    return f"{value:.3f}" if np.isfinite(value) else "-"


def _number(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None

"""A bank of calibrations as text: its settings, its holes, and how well it predicts itself."""

from collections.abc import Sequence
from dataclasses import asdict

import numpy as np

from tagmetry.camera import CameraBank, Gap, LeftOut, Repeat


def bank_table(bank: CameraBank, step: float | None = None) -> dict[str, object]:
    """Return a bank's numbers for JSON."""
    return {
        "name": bank.name,
        "zoom_is_digital": bank.zoom_is_digital,
        "may_scale": bank.may_scale,
        "calibrations": [
            {
                "size_px": node.camera.size_px,
                "zoom": node.zoom,
                "focus": node.focus,
                "approach": node.approach,
                "focal_px": node.camera.focal_px,
                "center_px": node.camera.center_px,
                "has_covariance": node.camera.covariance is not None,
            }
            for node in bank.nodes
        ],
        "gaps": [asdict(gap) for gap in bank.gaps(_step(bank, step))],
        "leave_one_out": [_finite(asdict(row)) for row in bank.leave_one_out()],
        "repeats": [_finite(asdict(repeat)) for repeat in bank.repeats()],
    }


def bank_lines(bank: CameraBank, step: float | None = None) -> list[str]:
    """Return a bank's settings and what is odd about it as text.

    Args:
        bank: What is shown.
        step: Of the focus that counts as a gap when it is exceeded; the usual one when None.
    """
    count = len(bank.nodes)
    sizes = ", ".join(f"{width}x{height}" for width, height in bank.sizes_px)
    kind = "digital zoom" if bank.zoom_is_digital else "zoom as calibrated"
    head = f"{bank.name}: {count} calibration{'s' * (count > 1)} at {sizes}, {kind}"
    rows = {(r.width_px, r.height_px, r.zoom, r.focus): r for r in bank.leave_one_out()}
    lines = [head, "  image       zoom  focus         fx         cx         cy  left one out"]
    for node in sorted(bank.nodes, key=lambda n: (n.camera.size_px, n.zoom, n.focus)):
        camera = node.camera
        size = f"{camera.width_px}x{camera.height_px}"
        numbers = (
            f"{camera.focal_px[0]:10.2f} {camera.center_px[0]:10.2f} {camera.center_px[1]:10.2f}"
        )
        text = _left_out_text(rows.get((*camera.size_px, node.zoom, node.focus)))
        approach = f"  {node.approach}" if node.approach else ""
        lines.append(f"  {size:<10} {node.zoom:5g} {node.focus:6g} {numbers}  {text}{approach}")
    step = _step(bank, step)
    gaps = _gap_lines(bank.gaps(step), step)
    return [*lines, *gaps, *_two_lines(bank), *_repeat_lines(bank.repeats())]


def _finite(row: dict[str, float | None]) -> dict[str, float | None]:
    """Return a row with null where two cameras share no ray."""
    return {key: None if value in (None, float("inf")) else value for key, value in row.items()}


def _step(bank: CameraBank, step: float | None) -> float:
    """Return the step asked for, or the median distance of neighbours in focus."""
    if step is not None:
        return step
    foci = np.unique([node.focus for node in bank.nodes])
    return float(np.median(np.diff(foci))) if foci.size > 1 else 1.0


def _left_out_text(row: LeftOut | None) -> str:
    if row is None:
        return "-"
    moved = f"{row.center_px:.2f} px centre, {row.worst_px:.2f} px worst"
    return f"{row.focal_percent:+.3f} % focal, {moved}"


def _gap_lines(gaps: Sequence[Gap], step: float) -> list[str]:
    return [
        f"  GAP: no calibration between focus {gap.low_focus:g} and {gap.high_focus:g} "
        f"({gap.width_px}x{gap.height_px}, zoom {gap.zoom:g}), more than the step of {step:g}"
        f"{gap_doubt(gap)}"
        for gap in gaps
    ]


def gap_doubt(gap: Gap) -> str:
    """Return how well the focal length is known half way, as the end of a sentence."""
    if gap.focal_sd_percent is None:
        return "; how exact is not known, as the calibrations state no covariance"
    return f"; half way the focal length is known to {gap.focal_sd_percent:.2g} % (one deviation)"


def _two_lines(bank: CameraBank) -> list[str]:
    """Say what a bank of two cannot know: none can be left out to test the other."""
    if len({node.focus for node in bank.nodes}) != 2:
        return []
    return [
        f"  ONLY TWO, at focus {gap.low_focus:g} and {gap.high_focus:g}: nothing tells how the "
        f"camera bends between them{gap_doubt(gap)}; calibrate between"
        for gap in bank.gaps(1e-9)
    ]


def _repeat_lines(repeats: Sequence[Repeat]) -> list[str]:
    lines = []
    for repeat in repeats:
        line = (
            f"  focus {repeat.focus:g} (zoom {repeat.zoom:g}) was calibrated {repeat.count} times: "
            f"up to {repeat.worst_px:.2f} px from their mean"
        )
        if repeat.excess is not None:
            line += f", {repeat.excess:.1f} times the variance that they state"
        if repeat.hysteresis_px is not None:
            line += f"; from near and from far differ by {repeat.hysteresis_px:.2f} px"
        lines.append(line)
    return lines

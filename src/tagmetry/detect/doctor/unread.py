"""Squares that are almost a marker: too small, too blurred, or with wrong bits?"""

from collections.abc import Sequence

import numpy as np

from tagmetry.detect.detection import Detection
from tagmetry.detect.doctor.advice import Advice, Severity
from tagmetry.detect.doctor.edges import principal_blurs_px, side_blurs_px, side_normals
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.suspects import px_per_cell, suspects

NEEDED_PX_PER_CELL = 2.0
BLURRED_CELLS = 0.4  # standard deviation of the blur beyond which bits run into each other
_MOVED = 1.8  # ratio of the blurs along and across beyond which the camera or marker moved


def check_unread(evidence: Evidence) -> tuple[Advice, ...]:
    """Give each square that is almost a marker its likely cause, and report each cause once."""
    squares = suspects(evidence)
    cells_px = dict(zip(squares, px_per_cell(squares, evidence.families), strict=True))
    small = [one for one in squares if cells_px[one] < NEEDED_PX_PER_CELL]
    rest = [one for one in squares if one not in small]
    blurs = {one: blur_px(evidence, [one]) for one in rest}
    blurred = [one for one in rest if blurs[one][0] > BLURRED_CELLS * cells_px[one]]
    damaged = [one for one in rest if one not in blurred]
    severity: Severity = "hint" if evidence.found else "problem"
    return (
        *_too_small(small, [cells_px[one] for one in small], severity),
        *_too_blurred(evidence, blurred, [cells_px[one] for one in blurred], severity),
        *(_wrong_bits(one, evidence, severity) for one in damaged),
    )


def blur_px(evidence: Evidence, squares: Sequence[Detection]) -> tuple[float, float]:
    """Return the blur along its widest direction and across it; NaN where no edge is clear."""
    cells_px = px_per_cell(squares, evidence.families)
    blurs = np.concatenate(
        [
            side_blurs_px(evidence.grey, square.corners_px, cell_px)
            for square, cell_px in zip(squares, cells_px, strict=True)
        ]
    )
    normals = np.concatenate([side_normals(square.corners_px) for square in squares])
    clear = np.isfinite(blurs)
    if clear.sum() < 2:
        return float("nan"), float("nan")
    return principal_blurs_px(blurs[clear], normals[clear])


def blur_words(along_px: float, across_px: float) -> tuple[str, str]:
    """Return what kind of blur it is, and what helps."""
    if along_px > _MOVED * across_px:
        kind = f"{along_px:.1f} px one way and {across_px:.1f} px across it: something moved"
        return kind, "a shorter exposure with more light, or hold still"
    kind = f"{along_px:.1f} px: out of focus, or moved along a diagonal"
    return kind, "focus by hand on the marker; a shorter exposure if anything moves"


def _too_small(
    squares: Sequence[Detection], cells_px: Sequence[float], severity: Severity
) -> tuple[Advice, ...]:
    if not squares:
        return ()
    largest_px, cell_px = max(
        (one.side_px, cell) for one, cell in zip(squares, cells_px, strict=True)
    )
    return (
        Advice(
            severity,
            "too small",
            f"{_count(squares)} almost read as {squares[0].family}: the largest has sides of "
            f"{largest_px:.0f} px, {cell_px:.1f} px per cell; about "
            f"{NEEDED_PX_PER_CELL:g} are needed",
            f"come {NEEDED_PX_PER_CELL / cell_px:.1f} times nearer or more, zoom in, print larger, "
            "take more resolution, or a family with fewer cells",
        ),
    )


def _too_blurred(
    evidence: Evidence,
    squares: Sequence[Detection],
    cells_px: Sequence[float],
    severity: Severity,
) -> tuple[Advice, ...]:
    if not squares:
        return ()
    kind, remedy = blur_words(*blur_px(evidence, squares))
    return (
        Advice(
            severity,
            "too blurred",
            f"{_count(squares)} almost read as {squares[0].family}; cells of "
            f"{min(cells_px):.1f} px are blurred by {kind}",
            remedy,
        ),
    )


def _wrong_bits(square: Detection, evidence: Evidence, severity: Severity) -> Advice:
    forgiven = next(one.forgiven_bits for one in evidence.families if one.name == square.family)
    x, y = square.center_px
    return Advice(
        severity,
        "wrong bits",
        f"the square at ({x:.0f}, {y:.0f}) is probably {square.family} id {square.id} with "
        f"{square.hamming} wrong bits; {forgiven} are forgiven",
        "clean it, take away what covers it, avoid glare and bends; if this code was never "
        "printed, the dictionary is another one",
    )


def _count(squares: Sequence[Detection]) -> str:
    return "1 square" if len(squares) == 1 else f"{len(squares)} squares"

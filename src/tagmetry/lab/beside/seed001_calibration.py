"""The ceiling camera beside equation 8 of seed 001."""

from collections.abc import Sequence

import numpy as np

from tagmetry.lab.beside.quantities import values_of
from tagmetry.lab.beside.sample import rounded
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rigs.camera_numbers import PARAMETERS
from tagmetry.lab.rows import Quantity
from tagmetry.record.report import Cell, ReportTable

_LENS = PARAMETERS[4:]
_ERRORS = ("rms px", "projection rms px")


def conclude(rows: Sequence[Quantity]) -> Conclusions:
    """Return the camera's numbers beside the true ones, and whether ours are near enough."""
    return Conclusions(
        checks=(_lens_check(rows), _projection_check(rows)),
        tables=(_camera(rows), _errors(rows)),
        remarks=tuple(seed001().remarks[:2]),
    )


def _lens_check(rows: Sequence[Quantity]) -> Check:
    printed = dict(zip(_LENS, seed001().camera.deviations, strict=True))
    shares = [_rms(rows, "tagmetry", name) / printed[name] for name in _LENS]
    worst = int(np.argmax(shares))
    return Check(
        "coefficients of the lens nearer to the truth than the paper's printed uncertainty",
        "within ± 0.03 (k) and ± 0.01 (p)",
        f"the worst, {_LENS[worst]}, is off by {100 * shares[worst]:.1f} % of that",
        bool(shares[worst] <= 1),
    )


def _projection_check(rows: Sequence[Quantity]) -> Check:
    ours, theirs = (float(values_of(rows, m, _ERRORS[1]).max()) for m in ("tagmetry", "paper"))
    return Check(
        "projections over the whole image",
        "nearer to the true ones than by the paper's steps",
        f"{ours:.3f} px rms, by the paper's steps {theirs:.3f} px",
        ours <= theirs,
    )


def _camera(rows: Sequence[Quantity]) -> ReportTable:
    header = (
        "",
        "true",
        "ours, mean",
        "our error rms",
        "stated sd",
        "its steps: error rms",
        "better?",
    )
    lines = tuple(_line(rows, name) for name in PARAMETERS)
    return ReportTable("seed001_camera", "Equation 8: the camera", header, lines)


def _line(rows: Sequence[Quantity], name: str) -> tuple[Cell, ...]:
    true = next(row.true for row in rows if row.name == name)
    sd = np.mean([row.sd for row in rows if row.name == name and row.method == "tagmetry"])
    ours, theirs = _rms(rows, "tagmetry", name), _rms(rows, "paper", name)
    mean = float(values_of(rows, "tagmetry", name).mean())
    better = "yes" if ours <= theirs else "no"
    return name, true, mean, rounded(ours), rounded(float(sd)), rounded(theirs), better


def _errors(rows: Sequence[Quantity]) -> ReportTable:
    lines: tuple[tuple[Cell, ...], ...] = tuple(
        (name, *(rounded(float(values_of(rows, m, name).mean())) for m in ("paper", "tagmetry")))
        for name in _ERRORS
    )
    header = ("", "its steps", "ours")
    return ReportTable("seed001_calibration", "Errors of the calibration", header, lines)


def _rms(rows: Sequence[Quantity], method: str, name: str) -> float:
    true = next(row.true for row in rows if row.name == name)
    return float(np.sqrt(((values_of(rows, method, name) - true) ** 2).mean()))

"""The camera beside tables 3 to 6 of seed 003."""

from collections.abc import Sequence

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.quantities import values_of
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed003 import seed003
from tagmetry.lab.rigs.camera_numbers import PARAMETERS
from tagmetry.lab.rows import Quantity
from tagmetry.record.report import Cell, ReportTable

_ERRORS = ("rms px", "tutorial error px", "projection rms px", "views")
_TRUTH = (
    "The published camera is the true one here: the errors are those of finding it again. Three of "
    "the 35 poses are printed (views 1, 2 and 35); the other 32 are ours."
)
_WHOLE = (
    "The projection error is over all of the picture that the lens reaches: single coefficients "
    "of a lens balance each other and say little by themselves."
)


def conclude(rows: Sequence[Quantity]) -> Conclusions:
    """Return the camera, the errors and the poses, and whether the published error is reached."""
    ours = values_of(rows, "tagmetry", "tutorial error px")
    printed_px = seed003().calibration.error_px
    check = Check(
        "calibration error as the paper counts it",
        f"at most {printed_px:.4f} px",
        f"{ours.mean():.5f} px (worst of {len(ours)}: {ours.max():.5f} px)",
        bool(ours.max() <= printed_px),
    )
    poses = [name for name in dict.fromkeys(row.name for row in rows) if name.startswith("view ")]
    return Conclusions(
        checks=(check,),
        tables=(
            _table("seed003_camera", "Tables 3 and 4: the camera", rows, PARAMETERS),
            _errors(rows),
            _table(
                "seed003_poses",
                "Tables 5 and 6: rotation vectors (rad) and translations (squares) of the printed "
                "views",
                rows,
                poses,
            ),
        ),
        remarks=(_TRUTH, _WHOLE, *seed003().remarks[:4]),
    )


def _table(name: str, title: str, rows: Sequence[Quantity], names: Sequence[str]) -> ReportTable:
    header = (
        "", "published, here true", "ours, mean", "our error rms", "stated sd",
        "its steps, mean", "their error rms", "better?",
    )  # fmt: skip
    return ReportTable(name, title, header, tuple(_line(rows, one) for one in names))


def _line(rows: Sequence[Quantity], name: str) -> tuple[Cell, ...]:
    true = next(row.true for row in rows if row.name == name)
    ours, theirs = values_of(rows, "tagmetry", name), values_of(rows, "paper", name)
    own_rms, their_rms = _rms(ours - true), _rms(theirs - true)
    sd = [row.sd for row in rows if row.name == name and row.method == "tagmetry"]
    return (
        name,
        true,
        float(ours.mean()),
        own_rms,
        float(np.mean(sd)),
        float(theirs.mean()),
        their_rms,
        "yes" if own_rms <= their_rms else "no",
    )


def _errors(rows: Sequence[Quantity]) -> ReportTable:
    printed = {"tutorial error px": seed003().calibration.error_px, "views": 35.0}
    lines = tuple(
        (
            name,
            printed.get(name, float("nan")),
            float(values_of(rows, "paper", name).mean()),
            float(values_of(rows, "tagmetry", name).mean()),
        )
        for name in _ERRORS
    )
    header = ("", "published", "its steps on the twin", "ours")
    return ReportTable("seed003_errors", "Errors of the calibration", header, lines)


def _rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).mean()))

"""What is concluded from an experiment: checks, tables beside the published ones, figures."""

from dataclasses import dataclass

from tagmetry.record.report import ReportFigure, ReportTable


@dataclass(frozen=True)
class Check:
    """Something that must hold.

    Attributes:
        told: What must hold, in words.
        required: The bound, in words with its unit.
        measured: What came out, in words with its unit.
        holds: Whether it does; None where there is nothing to hold it against.
    """

    told: str
    required: str
    measured: str
    holds: bool | None


@dataclass(frozen=True)
class Conclusions:
    """What an experiment says.

    Attributes:
        checks: What must hold.
        tables: Ours beside the published, row by row.
        figures: Not drawn yet.
        remarks: What to know about the published figures, and about ours.
    """

    checks: tuple[Check, ...] = ()
    tables: tuple[ReportTable, ...] = ()
    figures: tuple[ReportFigure, ...] = ()
    remarks: tuple[str, ...] = ()

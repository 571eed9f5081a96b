"""A table of a report, numbers in full."""

import csv
import io
from dataclasses import dataclass

Cell = str | float | int


@dataclass(frozen=True)
class ReportTable:
    """Rows under a heading.

    Attributes:
        name: Of its file, without the ending.
        title: For people.
        header: One name for each column, with its unit.
        rows: The cells; numbers in full.
    """

    name: str
    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]

    def csv_text(self) -> str:
        """Return it as CSV, numbers to the last digit."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.header)
        writer.writerows(self.rows)
        return text.getvalue()

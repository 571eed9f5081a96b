"""All readings of one of seed 003's tables, and its accuracy as the paper counts it.

relative error = |measured - actual| / |actual|, 0 where the actual position is 0
accuracy = 100 % - mean relative error (its equation 6).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.published.seed003 import PositionTable
from tagmetry.lab.rows import Position

_RESOLUTION_CM = 0.1  # of the paper's readings


@dataclass(frozen=True, eq=False)
class Line:
    """A regression line, measured = constant + slope * actual."""

    constant_cm: float
    slope: float


@dataclass(frozen=True, eq=False)
class Readings:
    """Positions along one axis at one distance, measured some times.

    Attributes:
        actual_cm: Shape (rows,).
        measured_cm: Shape (repeats, rows); NaN where the marker was not found.
    """

    actual_cm: Array
    measured_cm: Array

    @property
    def absolute_cm(self) -> Array:
        """Absolute errors, shape (repeats, rows)."""
        return np.abs(self.measured_cm - self.actual_cm)

    @property
    def relative_percent(self) -> Array:
        """Relative errors, shape (repeats, rows)."""
        by_cm = np.where(self.actual_cm == 0, np.inf, np.abs(self.actual_cm))
        return np.asarray(100 * self.absolute_cm / by_cm)

    @property
    def accuracies_percent(self) -> Array:
        """Accuracy of every repeat, by equation 6, shape (repeats,)."""
        return np.asarray(100 - self.relative_percent.mean(axis=1))

    @property
    def line(self) -> Line:
        """The regression line through all readings."""
        actual = np.broadcast_to(self.actual_cm, self.measured_cm.shape)
        slope, constant_cm = np.polyfit(actual.ravel(), self.measured_cm.ravel(), 1)
        return Line(float(constant_cm), float(slope))

    @property
    def rounded_cm(self) -> Array:
        """Absolute errors of the readings to 0.1 cm, as the paper reads, worst repeat, (rows,)."""
        read_cm = np.round(self.measured_cm / _RESOLUTION_CM) * _RESOLUTION_CM
        return np.asarray(np.abs(read_cm - self.actual_cm).max(axis=0).round(6))


def readings_of(
    rows: Sequence[Position], table: PositionTable, method: str, assumed: str = "right"
) -> Readings:
    """Return the readings of a method at the positions of a table; none where it was not run."""
    own = [r for r in rows if (r.table, r.method, r.assumed) == (table.table, method, assumed)]
    count = len(table.rows)
    ordered = sorted(own, key=lambda r: (r.repeat, r.row))
    measured_cm = np.array([r.measured_cm for r in ordered]).reshape(-1, count)
    return Readings(np.array([row[1] for row in table.rows]), measured_cm)


def printed(table: PositionTable) -> Readings:
    """Return the readings that the paper prints."""
    numbers = np.array(table.rows)
    return Readings(numbers[:, 1], numbers[None, :, 0])

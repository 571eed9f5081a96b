"""Pictures that an engine looked at, summed up, and where it ends."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.rigs.limit_sweeps import SWEEPS
from tagmetry.lab.rows import Limit

ENOUGH = 0.95  # of the markers


@dataclass(frozen=True)
class Looks:
    """What one engine made of pictures that are alike.

    Attributes:
        rows: One for each picture.
    """

    rows: tuple[Limit, ...]

    @cached_property
    def found(self) -> int:
        """How many markers it found."""
        return sum(row.found for row in self.rows)

    @property
    def recall(self) -> float:
        """Share of the markers that it found."""
        return self.found / max(sum(row.expected for row in self.rows), 1)

    @property
    def false_positives(self) -> int:
        """What else it found."""
        return sum(row.false_positives for row in self.rows)

    @property
    def corner_px(self) -> float:
        """Root mean square error of a corner's coordinate; NaN where none was found."""
        return float(np.sqrt(self._mean(np.square([row.corner_rms_px for row in self.rows]))))

    @property
    def bound_px(self) -> float:
        """The least that the noise allows."""
        return float(np.sqrt(np.mean(np.square([row.bound_px for row in self.rows]))))

    @property
    def distance2(self) -> float:
        """Mean squared Mahalanobis distance of the corners; NaN where no covariance is stated."""
        return self._mean(np.array([row.distance2 for row in self.rows]))

    @property
    def position_percent(self) -> float:
        """Error of the markers' places, of their distances."""
        return self._mean(np.array([row.position_percent for row in self.rows]))

    @property
    def angle_deg(self) -> float:
        """Error of their rotations."""
        return self._mean(np.array([row.angle_deg for row in self.rows]))

    @property
    def flipped(self) -> float:
        """Share of the found that have the wrong pose; NaN where none was found."""
        return sum(row.flips for row in self.rows) / self.found if self.found else float("nan")

    def _mean(self, values: Array) -> float:
        """Return the mean over all markers that were found, of means (n,) over each picture's."""
        counts = np.array([row.found for row in self.rows], dtype=np.float64)
        known = (counts > 0) & np.isfinite(values)
        if not known.any():
            return float("nan")
        return float(np.average(values[known], weights=counts[known]))


@dataclass(frozen=True)
class Limits:
    """All pictures of a run.

    Attributes:
        rows: One for each picture and engine.
    """

    rows: tuple[Limit, ...]

    @cached_property
    def engines(self) -> tuple[str, ...]:
        """Who looked."""
        return tuple(dict.fromkeys(row.engine for row in self.rows))

    @cached_property
    def variables(self) -> tuple[str, ...]:
        """What was varied, in the order of the sweeps."""
        measured = {row.variable for row in self.rows}
        return tuple(variable for variable in SWEEPS if variable in measured)

    def looks(self, variable: str, engine: str) -> dict[float, Looks]:
        """Return what an engine made of every value, from the easiest to the hardest."""
        found: dict[float, list[Limit]] = {}
        for row in self.rows:
            if (row.variable, row.engine) == (variable, engine):
                found.setdefault(row.value, []).append(row)
        return {v: Looks(tuple(found[v])) for v in SWEEPS[variable].values if v in found}


@dataclass(frozen=True)
class End:
    """Where an engine ends.

    Attributes:
        value: The hardest at which nearly all markers are found, as at all easier ones; None where
            there is none.
        is_last: Nothing harder was tried.
    """

    value: float | None
    is_last: bool

    def __str__(self) -> str:
        if self.value is None:
            return "nowhere"
        return f"{self.value:g}" + "*" * self.is_last


def end_of(looks: dict[float, Looks]) -> End:
    """Return where an engine ends on a sweep."""
    last: float | None = None
    for value, one in looks.items():
        if one.recall < ENOUGH:
            return End(last, is_last=False)
        last = value
    return End(last, is_last=True)


def limits(rows: Sequence[Limit]) -> Limits:
    """Return rows as a run."""
    return Limits(tuple(rows))

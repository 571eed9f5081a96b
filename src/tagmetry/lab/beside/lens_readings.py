"""Readings of depth and turn: picked by their settings, with errors in the paper's units."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.lab.lens_row import LensReading

_FLIP_DEG = 1.0  # smaller errors of the turn are none of the other pose


@dataclass(frozen=True)
class LensReadings:
    """Some of the readings of an experiment."""

    rows: tuple[LensReading, ...]

    def where(self, **settings: Any) -> "LensReadings":  # noqa: ANN401 (what a field may be)
        """Return the readings whose fields are so."""
        wanted = settings.items()
        return LensReadings(
            tuple(row for row in self.rows if all(getattr(row, k) == v for k, v in wanted))
        )

    def by(self, field: str) -> dict[Any, "LensReadings"]:
        """Return the readings by a field's values, in their order."""
        values = sorted({getattr(row, field) for row in self.rows})
        return {value: self.where(**{field: value}) for value in values}

    @property
    def conditions(self) -> tuple["LensReadings", ...]:
        """The readings of each turn and depth, in their order."""
        turns = self.by("turn_deg").values()
        return tuple(part for turn in turns for part in turn.by("depth_m").values())

    def column(self, field: str) -> Array:
        """Return a field of all readings, shape (n,)."""
        return np.array([getattr(row, field) for row in self.rows], dtype=np.float64)

    @property
    def errors_percent(self) -> Array:
        """Error rates of the depth: equation 9, shape (n,)."""
        true_m = self.column("depth_m")
        return np.asarray(100 * (self.column("measured_m") - true_m) / true_m)

    @property
    def errors_deg(self) -> Array:
        """Errors of the turn, shape (n,)."""
        return np.asarray(self.column("measured_deg") - self.column("turn_deg"))

    @property
    def flipped(self) -> BoolArray:
        """Which have the other pose: turned about as far to the other side, shape (n,)."""
        nearer_other = np.abs(self.errors_deg + 2 * self.column("turn_deg")) < np.abs(
            self.errors_deg
        )
        return np.asarray(nearer_other & (np.abs(self.errors_deg) > _FLIP_DEG))

    @property
    def found_share(self) -> float:
        """How many of them have a value."""
        return float(np.isfinite(self.column("measured_m")).mean()) if self.rows else 0.0

    @property
    def mean_percent(self) -> float:
        """Mean error rate as the paper records it; NaN unless the marker was always recognized."""
        return float(self.errors_percent.mean()) if self.rows else float("nan")

    @property
    def range_m(self) -> float:
        """From the nearest to the farthest depth that was always recognized, without a hole."""
        read = [(z, part.found_share == 1) for z, part in self.by("depth_m").items()]
        longest, start = 0.0, None
        for depth_m, is_read in read:
            start = (depth_m if start is None else start) if is_read else None
            longest = max(longest, depth_m - start) if start is not None else longest
        return longest

    def covered_share(self, deviations: float = 1.96) -> float:
        """Return how many depths lie within so many of their stated deviations."""
        off = np.abs(self.column("measured_m") - self.column("depth_m")) / self.column("sd_m")
        known = off[np.isfinite(off)]
        return float((known <= deviations).mean()) if len(known) else float("nan")


def result_readings(rows: Sequence[LensReading], **settings: Any) -> LensReadings:  # noqa: ANN401
    """Return the results, without the traces, whose fields are so."""
    return LensReadings(tuple(rows)).where(image=-1, **settings)


def rms(errors: Array) -> float:
    """Return the root mean square of those errors (n,) that are known; NaN where none is."""
    known = errors[np.isfinite(errors)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else float("nan")

"""Repeated measurements: picked by their settings, and their mean with a confidence interval."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.stats import t as student

from tagmetry.geometry import Array
from tagmetry.lab.rows import Followed, Localization, RobotPlace

Located = Localization | RobotPlace | Followed
_OURS = ("planar", "joint", "covariance")


@dataclass(frozen=True)
class Mean:
    """A mean with its 95 % confidence interval by Student's t; NaN where there are too few.

    Attributes:
        mean: Of all values that are numbers.
        half: Half the width of the interval.
        count: How many values are numbers.
        missing: How many are not.
    """

    mean: float
    half: float
    count: int
    missing: int

    @property
    def low(self) -> float:
        """Lower end of the interval."""
        return self.mean - self.half

    @property
    def high(self) -> float:
        """Upper end of the interval."""
        return self.mean + self.half


def rounded(value: float) -> float:
    """Return a number to three digits, as no more of it is known."""
    return float(f"{value:.3g}")


def mean_of(values: Array) -> Mean:
    """Return the mean of values (n,); those that are NaN are counted as missing."""
    known = values[np.isfinite(values)]
    missing = len(values) - len(known)
    if len(known) == 0:
        return Mean(np.nan, np.nan, 0, missing)
    if len(known) == 1:
        return Mean(float(known[0]), np.nan, 1, missing)
    half = student.ppf(0.975, len(known) - 1) * known.std(ddof=1) / np.sqrt(len(known))
    return Mean(float(known.mean()), float(half), len(known), missing)


def found_of(mean: Mean) -> str:
    """Return of how many pictures there is a value."""
    return f"{mean.count} of {mean.count + mean.missing}"


def told_of(mean: Mean, scale: float, unit: str) -> str:
    """Return a mean with its interval in words, and how many pictures gave no value."""
    lost = f"; {mean.missing} of {mean.missing + mean.count} not localized" if mean.missing else ""
    known = f"{rounded(scale * mean.mean):g} ± {rounded(scale * mean.half):g}"
    return f"{known} {unit}{lost}".strip()


def difference(more: Array, less: Array) -> Mean:
    """Return the mean of `more` less that of `less`, with Welch's confidence interval."""
    a, b = more[np.isfinite(more)], less[np.isfinite(less)]
    va, vb = a.var(ddof=1) / len(a), b.var(ddof=1) / len(b)
    freedom = (va + vb) ** 2 / (va**2 / (len(a) - 1) + vb**2 / (len(b) - 1))
    half = student.ppf(0.975, freedom) * np.sqrt(va + vb)
    missing = len(more) + len(less) - len(a) - len(b)
    return Mean(float(a.mean() - b.mean()), float(half), len(a) + len(b), missing)


@dataclass(frozen=True)
class Sample:
    """Errors of localization, some of all that were measured."""

    rows: tuple[Located, ...]

    def where(self, **settings: Any) -> "Sample":  # noqa: ANN401 (what a field may be)
        """Return the rows whose fields are so."""
        wanted = settings.items()
        return Sample(
            tuple(row for row in self.rows if all(getattr(row, k) == v for k, v in wanted))
        )

    def without(self, **settings: Any) -> "Sample":  # noqa: ANN401 (what a field may be)
        """Return the other rows."""
        left_out = set(map(id, self.where(**settings).rows))
        return Sample(tuple(row for row in self.rows if id(row) not in left_out))

    def by(self, field: str) -> "dict[float, Sample]":
        """Return the rows by the values of a field, in rising order."""
        parts: dict[float, list[Located]] = {}
        for row in self.rows:
            parts.setdefault(getattr(row, field), []).append(row)
        return {value: Sample(tuple(parts[value])) for value in sorted(parts)}

    def within(self, from_m: float, to_m: float) -> "Sample":
        """Return the rows of distances between two, both included."""
        return Sample(tuple(row for row in self.rows if from_m <= row.distance_m <= to_m))

    def values(self, field: str) -> Array:
        """Return a field of all rows, or one of those that people want instead."""
        if field in _WANTED:
            return _WANTED[field](self)
        return np.array([getattr(row, field) for row in self.rows], dtype=np.float64)

    def mean(self, field: str) -> Mean:
        """Return the mean of a field."""
        return mean_of(self.values(field))

    @cached_property
    def methods(self) -> tuple[str, ...]:
        """The methods that were measured."""
        return self.kinds("method")

    def kinds(self, field: str) -> tuple[str, ...]:
        """Return the values of a field as they come, each once."""
        return tuple(dict.fromkeys(getattr(row, field) for row in self.rows))

    @property
    def ours(self) -> "Sample":
        """The rows of tagmetry's best method: the first of the planar, the joint and the fused."""
        return self.where(method=next((one for one in _OURS if one in self.methods), _OURS[-1]))

    @property
    def paper(self) -> "Sample":
        """The rows of the paper's method with its own corners, which comes first."""
        named = [one for one in self.methods if one.startswith("paper")]
        return self.where(method=named[0] if named else "")


_WANTED: dict[str, Callable[[Sample], Array]] = {
    "angle_deg": lambda rows: np.degrees(rows.values("angle_rad")),
    "abs_z_m": lambda rows: np.abs(rows.values("z_m")),
    "place_m": lambda rows: np.hypot(rows.values("x_m"), rows.values("y_m")),
    "heading_deg": lambda rows: np.abs(np.degrees(rows.values("heading_rad"))),
}


def sample(rows: Sequence[Located]) -> Sample:
    """Return rows as a sample."""
    return Sample(tuple(rows))

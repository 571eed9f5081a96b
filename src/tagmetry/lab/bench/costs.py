"""What an image costs, and what a marker: time = a + b megapixels + c markers."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import nnls

from tagmetry.lab.bench.row import Row

_LEAST_CASES = 3


@dataclass(frozen=True)
class Cost:
    """How the time of an engine grows.

    Attributes:
        engine: Its name.
        threads: How many it was allowed.
        image_ms: What every image costs, a.
        megapixel_ms: What a megapixel costs, b.
        marker_ms: What a marker costs, c.
        misfit_percent: Root mean square of the times that the law does not explain, of the times.
    """

    engine: str
    threads: int
    image_ms: float
    megapixel_ms: float
    marker_ms: float
    misfit_percent: float


def costs(rows: Sequence[Row], standard: Collection[str]) -> list[Cost]:
    """Return the costs of every engine that was measured on enough cases.

    Args:
        rows: Of any cases.
        standard: Names of those that differ in size and number only.
    """
    usable = [row for row in rows if row.case in standard and row.p50_ms]
    keys = dict.fromkeys((row.engine, row.threads) for row in usable)
    groups = {key: [r for r in usable if (r.engine, r.threads) == key] for key in keys}
    return [_cost(group) for group in groups.values() if _is_enough(group)]


def _is_enough(group: Sequence[Row]) -> bool:
    """Say whether sizes and numbers vary, over enough cases."""
    sizes, numbers = {row.megapixels for row in group}, {row.expected for row in group}
    return len(group) >= _LEAST_CASES and len(sizes) > 1 and len(numbers) > 1


def _cost(group: Sequence[Row]) -> Cost:
    """Fit the law, each case weighted by its time; no part is negative."""
    times_ms = np.array([row.p50_ms for row in group], dtype=np.float64)
    A = np.array([[1.0, row.megapixels, row.expected] for row in group])
    parts, misfit = nnls(A / times_ms[:, None], np.ones(len(group)))
    rms_percent = 100 * misfit / np.sqrt(len(group))
    image_ms, megapixel_ms, marker_ms = parts.tolist()
    return Cost(
        group[0].engine, group[0].threads, image_ms, megapixel_ms, marker_ms, float(rms_percent)
    )

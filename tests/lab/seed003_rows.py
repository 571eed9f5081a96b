"""Readings as the experiment of seed 003 gives them, with errors that are known."""

import math

from tagmetry.lab.published.seed003 import seed003
from tagmetry.lab.rows import Position


def positions(error_cm: float = 0.0, scale: float = 1.0) -> list[Position]:
    """Readings of both methods, each twice, with a constant and a scale error."""
    return [
        Position(method, repeat, "right", t.table, n, row[1], scale * row[1] + error_cm, math.nan)
        for method in ("tagmetry", "paper")
        for repeat in range(2)
        for t in seed003().positions
        for n, row in enumerate(t.rows)
    ]

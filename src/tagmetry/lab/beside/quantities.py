"""Numbers of calibrations, picked by whose they are and what they are."""

from collections.abc import Sequence

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.rows import Quantity


def values_of(rows: Sequence[Quantity], method: str, name: str) -> Array:
    """Return what a method found of one quantity in all repeats, shape (n,)."""
    return np.array([row.value for row in rows if (row.method, row.name) == (method, name)])

"""Values of n things in arrays, a row each."""

from typing import Self

import numpy as np

from tagmetry.geometry.arrays import BoolArray, IntArray


class Rows:
    """A frozen dataclass whose fields are arrays of n rows."""

    def __len__(self) -> int:
        """The number of rows."""
        return len(next(iter(vars(self).values())))

    def at(self, rows: IntArray | BoolArray) -> Self:
        """Return some of the rows."""
        if rows.dtype == np.bool_ and rows.all():
            return self
        return type(self)(*(values[rows] for values in vars(self).values()))

    def with_some(self, rows: IntArray, others: Self) -> Self:
        """Return these with the rows at `rows` replaced by others, in their order."""
        replaced = type(self)(*(values.copy() for values in vars(self).values()))
        for values, new in zip(vars(replaced).values(), vars(others).values(), strict=True):
            values[rows] = new
        return replaced

    def and_also(self, others: Self) -> Self:
        """Return these rows, then others."""
        if not len(others):
            return self
        if not len(self):
            return others
        pairs = zip(vars(self).values(), vars(others).values(), strict=True)
        return type(self)(*(np.concatenate(pair) for pair in pairs))

"""Sheets behind each other: what the nearer ones leave free, the next one fills.

Within one point of the grid sheets are taken to lie side by side, as they do where they meet in an
edge: a wall's corner lets nothing through. A sheet that covers a point wholly fills what is left.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from tagmetry.geometry.arrays import FloatImage

Window = tuple[slice, slice]


@dataclass(frozen=True, eq=False)
class Patch:
    """What a sheet adds to a picture, on the points of a box.

    Attributes:
        radiance: Its light times its share of every point.
        share: How much of every point it covers, 0 to 1.
    """

    radiance: FloatImage
    share: FloatImage


@dataclass(frozen=True, eq=False)
class Canvas:
    """A picture that is filled from the front to the back.

    Attributes:
        light: What the sheets so far give.
        free: How much of every point they leave free.
    """

    light: FloatImage
    free: FloatImage

    @classmethod
    def empty(cls, shape: tuple[int, int]) -> Self:
        """Return a canvas without sheets."""
        return cls(np.zeros(shape, np.float32), np.ones(shape, np.float32))

    def has_room(self, window: Window) -> bool:
        """Say whether a sheet in a window could be seen."""
        return bool(self.free[window].any())

    def lay_behind(self, patch: Patch, window: Window) -> None:
        """Fill what is free in a window with a sheet."""
        free = self.free[window]
        filled = np.minimum(free, patch.share)
        share = np.where(patch.share > 0, patch.share, np.float32(1))
        self.light[window] += patch.radiance * (filled / share)
        free -= filled

    def before(self, background: float) -> FloatImage:
        """Return the light with a background of one radiance behind all."""
        return self.light + np.float32(background) * self.free

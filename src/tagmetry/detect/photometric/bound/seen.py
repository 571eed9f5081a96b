"""A marker's picture and how it is seen, and the pixels that see it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.geometry import Array, square_to_quad
from tagmetry.geometry.arrays import BoolArray

_MARGIN_PX = 6


@dataclass(frozen=True)
class Print:
    """A marker's picture and how it is seen.

    Attributes:
        picture: Cells, True is white, shape (m, m).
        margin_cells: How many cells of it lie outside the square whose corners are meant.
        black: Grey value of black.
        white: Grey value of white.
        blur_px: Standard deviation of the point spread, besides the pixel's own square.
        exponent: Values are those of light to the power 1 / exponent.
        motion_px: How far the image moves while it is exposed, right and down; the corners meant
            are those in the middle of the exposure.
        grey_per_electron: Grey values that an electron makes: the variance of light itself is that
            many times the grey value. 0 is light without noise of its own.
    """

    picture: BoolArray
    margin_cells: int
    black: float
    white: float
    blur_px: float
    exponent: float = 1.0
    motion_px: tuple[float, float] = (0.0, 0.0)
    grey_per_electron: float = 0.0

    @property
    def side_cells(self) -> int:
        """Cells along a side of the square whose corners are meant."""
        return len(self.picture) - 2 * self.margin_cells

    @property
    def spread_px(self) -> float:
        """Standard deviation of the point spread along an axis, the pixel's own square in it."""
        return float(np.hypot(self.blur_px, np.sqrt(1 / 12)))

    @cached_property
    def shifts_px(self) -> Array:
        """Where the image is at moments of the exposure, against its middle, shape (k, 2).

        From one to the next it moves by no more than the blur smooths over.
        """
        length_px = float(np.hypot(*self.motion_px))
        count = 1 + int(np.ceil(length_px / self.spread_px)) if length_px else 1
        return np.outer((np.arange(count) + 0.5) / count - 0.5, self.motion_px)


@dataclass(frozen=True, eq=False)
class Window:
    """The pixels around a marker.

    Attributes:
        H: From the unit square to their coordinates, shape (3, 3).
        size_px: Columns and rows.
    """

    H: Array
    size_px: tuple[int, int]

    @classmethod
    def around(cls, corners_px: Array, seen: Print) -> "Window":
        """Return all pixels that a marker's picture reaches."""
        reach_px = _reach_px(corners_px, seen)
        low = np.floor(corners_px.min(axis=0)) - reach_px
        columns, rows = (np.ceil(corners_px.max(axis=0) - low) + reach_px).astype(int).tolist()
        return cls(square_to_quad(corners_px - low), (columns, rows))


def _reach_px(corners_px: Array, seen: Print) -> int:
    side_px = np.ptp(corners_px, axis=0).max()
    margin_px = (seen.margin_cells + 1) * side_px / seen.side_cells
    return int(_MARGIN_PX + np.ceil(margin_px + np.hypot(*seen.motion_px) / 2))

"""The markers that are followed: where each was seen last, and how it moved."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from tagmetry.detect.photometric import LOOK_COUNT
from tagmetry.detect.rows import Rows
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, IntArray

Spins = NDArray[np.complex128]


@dataclass(frozen=True, eq=False)
class Tracks(Rows):
    """n markers, a row each.

    Attributes:
        families: Places of their families in the detector's list, shape (n,).
        ids: Shape (n,).
        is_inverted: White on black, shape (n,).
        corners_px: In the image that they were last seen in, shape (n, 4, 2).
        seen_s: When that was; NaN for those that were only announced, shape (n,).
        drift_px_s: Velocity of the middle, shape (n, 2).
        spin_s: How fast it grows (real part, 1 / s) and turns (imaginary part, rad / s, clockwise
            as seen), shape (n,).
        shake_px_s2: By what acceleration its corners were mispredicted, shape (n,).
        is_new: Seen once only: how it moves is not known, shape (n,).
        missed: In how many images it was not seen since, shape (n,).
        looks: How light, camera and blur made each look, NaN where that is not known, shape
            (n, 11); the fit of the next image begins with it.
    """

    families: IntArray
    ids: IntArray
    is_inverted: BoolArray
    corners_px: Array
    seen_s: Array
    drift_px_s: Array
    spin_s: Spins
    shake_px_s2: Array
    is_new: BoolArray
    missed: IntArray
    looks: Array

    @classmethod
    def begun(
        cls,
        families: IntArray,
        ids: IntArray,
        is_inverted: BoolArray,
        corners_px: Array,
        seen_s: float,
    ) -> Self:
        """Return markers that were seen for the first time."""
        count = len(ids)
        return cls(
            families,
            ids,
            is_inverted,
            corners_px,
            np.full(count, seen_s),
            np.zeros((count, 2)),
            np.zeros(count, dtype=np.complex128),
            np.zeros(count),
            np.ones(count, dtype=bool),
            np.zeros(count, dtype=np.int64),
            np.full((count, LOOK_COUNT), np.nan),
        )

    @classmethod
    def none(cls) -> Self:
        """Return no markers."""
        nothing = np.zeros(0, dtype=np.int64)
        return cls.begun(nothing, nothing, nothing > 0, np.zeros((0, 4, 2)), 0.0)

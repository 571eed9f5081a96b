"""The sides of markers as the image shows them: chords between corners, or the lens's curves."""

from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_REACH_PX = (2.0, 5.0)  # how far from a side pixels are looked at, at least and at most
_REACH_CELLS = 0.9
_BOWING_HALF_PX = 15.0
SAG_AT = np.linspace(-1.0, 1.0, 17)


@dataclass(frozen=True)
class Sides:
    """4 n sides, four after four: from corner i to corner i + 1.

    Attributes:
        middle: Shape (s, 2).
        along: Unit vectors, shape (s, 2).
        outward: Unit normals away from the marker, shape (s, 2).
        half_px: Half lengths, shape (s,).
        cell_px: Size of a cell perpendicular to the side, shape (s,).
        sag_px: How far outside the chord the side runs at `SAG_AT`, shape (s, 17).
    """

    middle: Array
    along: Array
    outward: Array
    half_px: Array
    cell_px: Array
    sag_px: Array

    @property
    def reach_px(self) -> Array:
        """How far from a side pixels belong to it alone, shape (s,)."""
        return np.clip(_REACH_CELLS * self.cell_px, *_REACH_PX)

    @property
    def may_bow(self) -> BoolArray:
        """Whether a side is long enough for a bow to be told from noise and dirt."""
        return np.asarray(self.half_px >= _BOWING_HALF_PX)

    @classmethod
    def of(cls, corners_px: Array, cell_counts: Array, camera: Camera | None) -> "Sides":
        """Return the sides of markers with corners (n, 4, 2) and n counts of cells."""
        starts = corners_px.reshape(-1, 2)
        ends = np.roll(corners_px, -1, axis=1).reshape(-1, 2)
        length = np.maximum(np.linalg.norm(ends - starts, axis=1), 1e-9)
        along = (ends - starts) / length[:, None]
        outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
        cells_px = _cell_heights(corners_px, outward) / np.repeat(cell_counts, 4)
        return cls(
            (starts + ends) / 2,
            along,
            outward,
            length / 2,
            cells_px,
            _sag(starts, ends, outward, camera),
        )


def _cell_heights(corners_px: Array, outward: Array) -> Array:
    """Return the marker's extent perpendicular to each side, shape (4 n,)."""
    opposite = (np.roll(corners_px, -2, axis=1) + np.roll(corners_px, -3, axis=1)) / 2
    own = (corners_px + np.roll(corners_px, -1, axis=1)) / 2
    across = (own - opposite).reshape(-1, 2)
    return np.asarray(np.abs((across * outward).sum(axis=1)))


def _sag(starts: Array, ends: Array, outward: Array, camera: Camera | None) -> Array:
    """Return how a straight edge between two pixels bows in this camera's image, shape (s, 17)."""
    if camera is None or not camera.lens.coefficients:
        return np.zeros((len(starts), len(SAG_AT)))
    first, last = camera.unproject(starts)[:, None], camera.unproject(ends)[:, None]
    chord = (starts[:, None] + ends[:, None]) / 2 + SAG_AT[:, None] * (ends - starts)[:, None] / 2
    share = (SAG_AT[:, None] + 1) / 2
    curve = camera.project(first + share * (last - first))
    return np.asarray(np.nan_to_num(((curve - chord) * outward[:, None]).sum(axis=2)))

"""How are the markers in pictures arranged, whatever was asked for?

A hypothesis says at which place of a lattice each id stands. It holds for a marker that lies where
the others' homography puts its place, the way up that the lattice says.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from tagmetry.calibrate.targets.homography import fitted_homography
from tagmetry.detect import Detection
from tagmetry.geometry import Array, apply_homography
from tagmetry.geometry.arrays import BoolArray, IntArray

Kind = Literal["charuco", "grid"]

_FARTHEST = 0.2  # steps of the lattice
_MOST_COLUMNS, _MOST_ROWS = 20, 60
_MOST_TURNED = 0.7  # cosine
_LEAST_MARKERS = 4


@dataclass(frozen=True)
class Arrangement:
    """Which place of a lattice each id has.

    Attributes:
        kind: Markers in the white squares of a chessboard, or in all places.
        columns: Squares, or markers, in a row.
        first_id: Id at the first place.
        flag: Of ChArUco: the top left square is white; of a grid: rows go up.
    """

    kind: Kind
    columns: int
    first_id: int = 0
    flag: bool = False

    def places(self, ids: IntArray) -> Array:
        """Return x to the right and y up of ids in steps, shape (n, 2); NaN where there is none."""
        k = ids - self.first_id
        row, column = self._charuco(k) if self.kind == "charuco" else divmod(k, self.columns)
        y = row if self.kind == "grid" and self.flag else -row
        places = np.stack([column, y], axis=1).astype(np.float64)
        return np.where(((k >= 0) & (row < _MOST_ROWS))[:, None], places, np.nan)

    def _charuco(self, k: IntArray) -> tuple[IntArray, IntArray]:
        """Return rows and columns of the white squares."""
        colours = np.add.outer(np.arange(_MOST_ROWS), np.arange(self.columns)) % 2
        row, column = np.nonzero(colours == (0 if self.flag else 1))
        known = np.clip(k, 0, len(row) - 1)
        return np.where(k < len(row), row[known], _MOST_ROWS), column[known]


@dataclass(frozen=True, eq=False)
class Fitting:
    """How markers of some pictures fit an arrangement.

    Attributes:
        arrangement: The arrangement.
        agreeing: How many markers are where it puts them.
        seen: How many there are in pictures with at least four.
        rows: How many rows it takes for the agreeing ones.
        side: Side of a marker in steps of the lattice, median; NaN where none agrees.
    """

    arrangement: Arrangement
    agreeing: int
    seen: int
    rows: int
    side: float

    @property
    def astray(self) -> int:
        """How many markers are elsewhere."""
        return self.seen - self.agreeing

    @property
    def share(self) -> float:
        """Of the markers that agree."""
        return self.agreeing / max(self.seen, 1)


def fitting(pictures: Sequence[Sequence[Detection]], arrangement: Arrangement) -> Fitting:
    """Return how the markers of pictures fit an arrangement."""
    agreeing, seen, rows, sides = 0, 0, 0, [np.zeros(0)]
    for markers in pictures:
        if len(markers) < _LEAST_MARKERS:
            continue
        places = arrangement.places(np.array([one.id for one in markers]))
        corners_px = np.array([one.corners_px for one in markers])
        agree, side = _agreeing(places, corners_px)
        agreeing, seen = agreeing + int(agree.sum()), seen + len(markers)
        if agree.any():
            rows = max(rows, int(np.abs(places[agree, 1]).max()) + 1)
            sides.append(side[agree])
    every = np.concatenate(sides)
    return Fitting(
        arrangement, agreeing, seen, rows, float(np.median(every)) if every.size else np.nan
    )


def best_fitting(
    pictures: Sequence[Sequence[Detection]], asked: Arrangement | None, first_ids: Sequence[int]
) -> Fitting | None:
    """Return the arrangement that most markers fit, what was asked for where that is as good.

    Args:
        pictures: Markers of one family in some pictures.
        asked: The arrangement asked for.
        first_ids: Ids that may be first.
    """
    if not any(len(markers) >= _LEAST_MARKERS for markers in pictures):
        return None
    tried = (fitting(pictures, one) for one in _hypotheses(first_ids))
    return max(tried, key=lambda one: (one.agreeing, -_differences(one.arrangement, asked)))


def _hypotheses(first_ids: Sequence[int]) -> Iterator[Arrangement]:
    kinds: tuple[Kind, ...] = ("charuco", "grid")
    for kind in kinds:
        for columns in range(1 if kind == "grid" else 2, _MOST_COLUMNS + 1):
            for first_id in first_ids:
                yield Arrangement(kind, columns, first_id, False)
                yield Arrangement(kind, columns, first_id, True)


def _differences(one: Arrangement, asked: Arrangement | None) -> float:
    if asked is None:
        return float(one.flag) + (one.first_id > 0)
    same = (one.kind == asked.kind, one.columns == asked.columns, one.first_id == asked.first_id)
    return float(sum(not each for each in same)) + 0.5 * (one.flag != asked.flag)


def _agreeing(places: Array, corners_px: Array) -> tuple[BoolArray, Array]:
    """Return which markers are in their place and upright, and their sides in steps."""
    count = len(places)
    nowhere = np.zeros(count, dtype=bool), np.full(count, np.nan)
    known = np.isfinite(places).all(axis=1)
    centres_px = corners_px.mean(axis=1)
    spread = np.ptp(places[known], axis=0) if known.any() else np.zeros(2)
    if known.sum() < _LEAST_MARKERS or (spread == 0).any():
        return nowhere
    steps_px = float(np.linalg.norm(np.ptp(centres_px, axis=0)) / np.linalg.norm(spread))
    H = fitted_homography(places[known], centres_px[known], _FARTHEST * steps_px)
    if not np.isfinite(H).all() or abs(np.linalg.det(H)) < 1e-9:
        return nowhere
    with np.errstate(all="ignore"):
        back = apply_homography(np.asarray(np.linalg.inv(H)), corners_px)
    off = np.linalg.norm(back.mean(axis=1) - np.nan_to_num(places, nan=np.inf), axis=1)
    return (off < _FARTHEST) & _upright(back), _sides(back)


def _upright(corners: Array) -> BoolArray:
    """Say which squares (n, 4, 2), clockwise from the top left, stand upright with y up."""
    along = _unit(corners[:, 1] - corners[:, 0])
    upward = _unit(corners[:, 0] - corners[:, 3])
    return np.asarray((along[:, 0] > _MOST_TURNED) & (upward[:, 1] > _MOST_TURNED))


def _unit(vectors: Array) -> Array:
    return np.asarray(vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12))


def _sides(corners: Array) -> Array:
    steps = np.roll(corners, -1, axis=1) - corners
    return np.asarray(np.linalg.norm(steps, axis=2).mean(axis=1))

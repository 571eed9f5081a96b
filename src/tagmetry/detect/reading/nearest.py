"""The marker that differs in the fewest bits from what was read."""

from dataclasses import dataclass

import numpy as np

from tagmetry.detect.reading.closest import clearness, clearness_of_each, closest, closest_of_each
from tagmetry.detect.reading.decode import Reading, Readings
from tagmetry.detect.reading.shelves import MOST_WRONG_BITS, shelves_of
from tagmetry.geometry.arrays import Array, IntArray
from tagmetry.markers import MarkerFamily


@dataclass(frozen=True)
class Match:
    """The nearest marker of a family.

    Attributes:
        family: The family.
        id: The nearest marker's id.
        quarters: By how many quarters clockwise it is turned against the quadrilateral.
        hamming: How many bits differ.
        confidence: Mean clearness of all cells, those read wrong counting against, 0 to 1.
    """

    family: MarkerFamily
    id: int
    quarters: int
    hamming: int
    confidence: float


@dataclass(frozen=True, eq=False)
class Matches:
    """The nearest marker of a family to each of m readings.

    Attributes:
        family: The family.
        indices: Places in its `packed_codes`, shape (m,).
        hammings: How many bits differ, shape (m,).
        confidences: As of a match, shape (m,).
    """

    family: MarkerFamily
    indices: IntArray
    hammings: IntArray
    confidences: Array

    @property
    def ids(self) -> IntArray:
        """The nearest markers, shape (m,)."""
        return self.indices % len(self.family)

    @property
    def quarters(self) -> IntArray:
        """By how many quarters clockwise each is turned against its quadrilateral, shape (m,)."""
        return self.indices // len(self.family)


def nearest(reading: Reading, family: MarkerFamily) -> Match:
    """Return the marker of a family that differs in the fewest bits."""
    index, hamming = closest(reading.words, family.packed_codes)
    bits = len(reading.margins)
    share = bits / (bits + _frame_cells(family))
    clear = clearness(reading.margins, family.packed_codes[index])
    confidence = share * clear + (1 - share) * reading.border_margin
    quarters, marker_id = divmod(index, len(family))
    return Match(family, marker_id, quarters, hamming, min(max(confidence, 0.0), 1.0))


def nearest_of_each(
    readings: Readings, rows: IntArray, family: MarkerFamily, most_wrong: int
) -> Matches:
    """Return which markers differ from readings in the fewest bits, as `nearest` does of one.

    Args:
        readings: Of squares.
        rows: Which of them are wanted, all with a border, shape (m,).
        family: The family.
        most_wrong: Where more bits differ, another marker may be nearer.
    """
    words, shelves = np.ascontiguousarray(readings.words[rows]), shelves_of(family)
    if shelves is None or most_wrong > MOST_WRONG_BITS:
        indices, hammings = closest_of_each(words, family.packed_codes)
    else:
        indices, hammings = shelves.closest_of_each(words)
    bits = readings.margins.shape[1]
    share = bits / (bits + _frame_cells(family))
    clear = clearness_of_each(readings.margins[rows], family.packed_codes[indices])
    confidence = share * clear + (1 - share) * readings.measures[rows, 2]
    return Matches(family, indices, hammings, np.clip(confidence, 0, 1))


def _frame_cells(family: MarkerFamily) -> int:
    """Return how many cells are alike on all markers of a family."""
    return len(family.layout.black_cells) + len(family.layout.white_cells)

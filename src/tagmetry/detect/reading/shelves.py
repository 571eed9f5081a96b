"""Of many codes, those that hardly differ from what was read.

Each code stands on four shelves, one for each quarter of its bits, at the place that these bits
name. Of a code read with few wrong bits, one quarter at least has none wrong or one: it stands on
that quarter's shelf at the place that was read, or at one that differs in a bit.

Reference: M. Norouzi, A. Punjani, D. Fleet, Fast Search in Hamming Space with Multi-Index Hashing,
CVPR 2012.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np
from numba import njit

from tagmetry.detect.reading.closest import count_ones
from tagmetry.geometry.arrays import IntArray
from tagmetry.markers import MarkerFamily
from tagmetry.markers.packed import Words

MOST_WRONG_BITS = 7  # with eight, two could be wrong in every quarter
_QUARTERS = 4
_DEARER = 5  # times as long takes a code on a shelf as one of all in a row
_PLACE = 2  # codes in whose time a place on a shelf is looked up
_REMEMBERED = 8  # families


@dataclass(frozen=True, eq=False)
class Shelves:
    """The n codes of a family in four orders.

    Attributes:
        bit_count: Of a code, at most 64.
        begins: Where on each shelf the codes begin whose quarter has a value, and at last their
            number, shape (4, values + 1).
        codes: In the order of each shelf, the first bit the highest of `bit_count`, shape (4, n).
        indices: Which code each is, shape (4, n).
    """

    bit_count: int
    begins: IntArray
    codes: Words
    indices: IntArray

    @classmethod
    def of(cls, words: Words, bit_count: int) -> Self:
        """Sort codes of a word each, shape (n, 1)."""
        codes, bits = _in_order(words, bit_count), _quarter_bits(bit_count)
        begins, orders = [], []
        for quarter in range(_QUARTERS):
            values = codes >> np.uint64(quarter * bits) & np.uint64(2**bits - 1)
            orders.append(np.argsort(values, kind="stable"))
            begins.append(np.searchsorted(values[orders[-1]], np.arange(2**bits + 1)))
        indices = np.stack(orders)
        return cls(bit_count, np.stack(begins), codes[indices], indices)

    def closest_of_each(self, read: Words) -> tuple[IntArray, IntArray]:
        """Return the index of the first of the nearest codes, and the number of differing bits.

        Args:
            read: Codes of a word each, shape (n, 1).

        Returns:
            Two arrays of shape (n,); more than `MOST_WRONG_BITS` where there may be nearer ones.
        """
        codes, bits = _in_order(read, self.bit_count), _quarter_bits(self.bit_count)
        return _closest_of_each(codes, bits, self.begins, self.codes, self.indices)


@lru_cache(_REMEMBERED)
def shelves_of(family: MarkerFamily) -> Shelves | None:
    """Return a family's codes on shelves; None where these are not worth it, or too long."""
    codes, bit_count = family.packed_codes, family.layout.bit_count
    if codes.shape[1] > 1 or not _are_worth_it(len(codes), _quarter_bits(bit_count)):
        return None
    return Shelves.of(codes, bit_count)


def _are_worth_it(count: int, bits: int) -> bool:
    """Say whether so many codes with so many bits in a quarter are compared sooner on shelves."""
    places = _QUARTERS * (bits + 1)
    return bool(_DEARER * places * (_PLACE + count / 2**bits) < count)


def _in_order(words: Words, bit_count: int) -> Words:
    """Return packed codes (n, 1) as numbers of so many bits, shape (n,)."""
    return words[:, 0].astype(">u8").view(np.uint64) >> np.uint64(64 - bit_count)


def _quarter_bits(bit_count: int) -> int:
    return -(-bit_count // _QUARTERS)


@njit(cache=True, nogil=True)
def _closest_of_each(
    read: Words, bits: int, begins: IntArray, codes: Words, indices: IntArray
) -> tuple[IntArray, IntArray]:
    nearest, fewest = np.zeros(read.size, np.int64), np.full(read.size, 64)
    last = np.uint64(2**bits - 1)
    for i in range(read.size):
        for quarter in range(_QUARTERS):
            value = int((read[i] >> np.uint64(quarter * bits)) & last)
            for wrong in range(bits + 1):
                place = value ^ ((1 << wrong) >> 1)
                begin, end = begins[quarter, place], begins[quarter, place + 1]
                for k in range(begin, end):
                    differing = count_ones(codes[quarter, k] ^ read[i])
                    index = indices[quarter, k]
                    if differing < fewest[i] or (differing == fewest[i] and index < nearest[i]):
                        nearest[i], fewest[i] = index, differing
    return nearest, fewest

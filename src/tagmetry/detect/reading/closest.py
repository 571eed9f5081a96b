"""Which code differs from what was read in the fewest bits, and how clearly was it read?"""

import numpy as np
from numba import njit

from tagmetry.geometry.arrays import Array, IntArray
from tagmetry.markers.packed import Words

_PAIRS = np.uint64(0x5555555555555555)
_FOURS = np.uint64(0x3333333333333333)
_EIGHTS = np.uint64(0x0F0F0F0F0F0F0F0F)
_ONES = np.uint64(0x0101010101010101)
_ONE, _TWO, _FOUR, _TOP = np.uint64(1), np.uint64(2), np.uint64(4), np.uint64(56)


@njit(cache=True, nogil=True)
def closest(read: Words, codes: Words) -> tuple[int, int]:
    """Return the index of the first of the nearest codes, and the number of differing bits.

    Args:
        read: One code in words, shape (words,).
        codes: Shape (n, words).
    """
    best, fewest = 0, 64 * read.size + 1
    for index in range(len(codes)):
        differing = 0
        for word in range(read.size):
            differing += count_ones(codes[index, word] ^ read[word])
        if differing < fewest:
            best, fewest = index, differing
    return best, fewest


@njit(cache=True, nogil=True)
def closest_of_each(read: Words, codes: Words) -> tuple[IntArray, IntArray]:
    """Return what `closest` does of each of several codes (m, words), two arrays of shape (m,)."""
    indices, hammings = np.empty(len(read), np.int64), np.empty(len(read), np.int64)
    for i in range(len(read)):
        indices[i], hammings[i] = closest(read[i], codes)
    return indices, hammings


@njit(cache=True, nogil=True)
def count_ones(word: np.uint64) -> int:
    """Return the number of ones in a word, added up in parallel: in pairs, in fours, in eights."""
    word -= (word >> _ONE) & _PAIRS
    word = (word & _FOURS) + ((word >> _TWO) & _FOURS)
    word = (word + (word >> _FOUR)) & _EIGHTS
    return int((word * _ONES) >> _TOP)


@njit(cache=True, nogil=True)
def clearness(margins: Array, code: Words) -> float:
    """Return the mean margin of a code's bits, each at most 1; those read wrong count against.

    Args:
        margins: How clearly each bit reads as white, shape (bits,).
        code: What should be read, in words.
    """
    octets = code.view(np.uint8)
    total = 0.0
    for k in range(margins.size):
        is_white = octets[k // 8] >> (7 - k % 8) & 1
        right = margins[k] if is_white else -margins[k]
        total += min(max(right, -1.0), 1.0)
    return total / margins.size


@njit(cache=True, nogil=True)
def clearness_of_each(margins: Array, codes: Words) -> Array:
    """Return what `clearness` does of each of m readings, (m, bits), and codes, (m, words)."""
    clear = np.empty(len(margins))
    for i in range(len(margins)):
        clear[i] = clearness(margins[i], codes[i])
    return clear

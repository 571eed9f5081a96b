"""Codes in 64-bit words, so that a machine compares all bits of a code at once."""

import numpy as np
from numpy.typing import NDArray

from tagmetry.geometry.arrays import BoolArray

Words = NDArray[np.uint64]


def packed(bits: BoolArray) -> Words:
    """Return rows of bits (n, bits) as words, shape (n, ceil(bits / 64)); missing bits are 0."""
    padded = np.pad(bits, [(0, 0), (0, -bits.shape[1] % 64)])
    return np.packbits(padded, axis=1).view(np.uint64)

"""Codes in 64-bit words, so that a machine compares all bits of a code at once."""

import numpy as np
from numpy.typing import NDArray

from tagmetry.geometry.arrays import BoolArray

Words = NDArray[np.uint64]


def packed(bits: BoolArray) -> Words:
    """Return rows of bits (n, bits) as words, shape (n, ceil(bits / 64)); missing bits are 0."""
    octets = np.packbits(bits, axis=1)
    padded = np.zeros((len(bits), -(-bits.shape[1] // 64) * 8), np.uint8)
    padded[:, : octets.shape[1]] = octets
    return padded.view(np.uint64)

"""How noisy are pixels? The median size of residuals tells, whatever the largest ones are.

Sizes are counted by their leading bits, in 16 steps from one power of two to the next, which is
quicker than sorting; between steps the median is interpolated.
"""

import numpy as np

from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.geometry.arrays import IntArray

LEAST_NOISE = 0.3  # grey values: that of rounding
_LEAST, _OCTAVES = -5, 14  # sizes from 2^-5 to 2^9 are told apart
_STEPS, _STEP_BITS = 16, 19  # of an octave; the bits that are left away
_FIRST = (127 + _LEAST) * _STEPS
_MEDIAN_OF_NORMAL = 0.6745


@kernel
def new_counts() -> IntArray:
    """Return counts of sizes, all zero."""
    return np.zeros(_OCTAVES * _STEPS, dtype=np.int64)


@kernel
def count_sizes(sizes: Narrow, lanes: int, every: int, counts: IntArray) -> None:
    """Count one of every so many sizes of a block, grey values."""
    for p in range(0, lanes, every):
        step = int(f32(sizes[p]).view(np.int32) >> _STEP_BITS) - _FIRST
        counts[min(max(step, 0), len(counts) - 1)] += 1


@kernel
def noise_of(counts: IntArray) -> float:
    """Return the deviation whose residuals have the median of the counted sizes, grey values."""
    half, below, step = 0.5 * counts.sum(), 0, 0
    while below + counts[step] < half:
        below += counts[step]
        step += 1
    low, high = _size(step), _size(step + 1)
    median = low + (high - low) * (half - below) / max(counts[step], 1)
    return float(max(median / _MEDIAN_OF_NORMAL, LEAST_NOISE))


@kernel
def _size(step: int) -> float:
    """Return the least size of a step, grey values."""
    return float((1.0 + (step % _STEPS) / _STEPS) * 2.0 ** (step // _STEPS + _LEAST))

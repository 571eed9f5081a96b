"""How what is seen at the places of a marker agrees with what is expected there.

With v the values at the k places, w what is expected, +1 and -1, and both less the parts that the
functions of light explain (even light, and light that falls off),

    half the contrast = v . w / w . w        correlation = v . w / (|v| |w|)
"""

import numpy as np
from numba import njit

from tagmetry.detect.track.cells import Places
from tagmetry.geometry import Array


@njit(cache=True, nogil=True, error_model="numpy")
def write_margins(
    values: Array, expected: Array, light: Array, margins: Array
) -> tuple[float, float]:
    """Write (value - middle) / half the contrast; return this half, and the correlation.

    Args:
        values: At the places, shape (k,).
        expected: There, -1 and +1, shape (k,).
        light: Orthonormal functions of light, shape (k, 3).
        margins: For the result, shape (k,).
    """
    of_values, of_expected = np.zeros(3), np.zeros(3)
    vv, vw, ww = 0.0, 0.0, 0.0
    for k in range(values.size):
        v, w = values[k], expected[k]
        vv, vw, ww = vv + v * v, vw + v * w, ww + w * w
        for t in range(3):
            of_values[t] += v * light[k, t]
            of_expected[t] += w * light[k, t]
    for t in range(3):
        vv -= of_values[t] ** 2
        vw -= of_values[t] * of_expected[t]
        ww -= of_expected[t] ** 2
    half = vw / ww
    for k in range(values.size):
        middle = 0.0
        for t in range(3):
            middle += (of_values[t] - half * of_expected[t]) * light[k, t]
        margins[k] = (values[k] - middle) / half if half != 0.0 else 0.0
    return half, vw / np.sqrt(vv * ww) if vv > 0.0 else 0.0


@njit(cache=True, nogil=True)
def write_shares(margins: Array, expected: Array, places: Places, shares: Array) -> None:
    """Write the number of wrong bits, the confidence, the right shares of frame and quiet zone.

    Args:
        margins: From above, shape (k,).
        expected: Shape (k,).
        places: What the k places are.
        shares: For the result, shape (4,).
    """
    bits, end = margins.size - places.plain.size, margins.size - places.quiet
    wrong, clear, framed, quiet = 0, 0.0, 0, 0
    for k in range(margins.size):
        right = margins[k] * expected[k]
        wrong += (k < bits) & (right <= 0)
        framed += (bits <= k) & (k < end) & (right > 0)
        quiet += (k >= end) & (right > 0)
        clear += min(max(right, -1.0), 1.0) if k < end else 0.0
    shares[0], shares[1] = wrong, min(max(clear / end, 0.0), 1.0)
    shares[2], shares[3] = framed / (end - bits), quiet / places.quiet if places.quiet else 1.0

"""Where a distortion polynomial stops growing, and so begins to show two rays at one pixel."""

import numpy as np

from tagmetry.geometry.arrays import Array


def least_positive_root(rising: Array) -> float:
    """Return the least q > 0 with 1 + a q + b q^2 + ... = 0, infinite if there is none.

    Solved for w = 1 / q, where the 1 is the leading coefficient: a last coefficient that is almost
    zero then does no harm. Roots beyond 1e12 count as none.

    Args:
        rising: The coefficients (1, a, b, ...), shape (n,).
    """
    w = np.roots(rising)
    real = w.real[(np.abs(w.imag) < 1e-9 * np.abs(w)) & (w.real > 1e-12)]
    return float(1 / real.max()) if real.size else float("inf")

"""Of squares that several looks saw almost alike, one is enough."""

import numpy as np
from numba import njit

from tagmetry.geometry.arrays import Array, BoolArray

_SAME_PX = 0.25  # corners closer than this in both directions


@njit(cache=True, nogil=True)
def distinct(corners_px: Array) -> BoolArray:
    """Say of each square whether no earlier one is almost the same, shape (n,).

    Args:
        corners_px: Shape (n, 4, 2), clockwise from any corner.
    """
    first = np.ones(len(corners_px), np.bool_)
    middle_x, middle_y = np.empty(len(corners_px)), np.empty(len(corners_px))
    for i in range(len(corners_px)):
        middle_x[i], middle_y[i] = corners_px[i, :, 0].mean(), corners_px[i, :, 1].mean()
    order = np.argsort(middle_y, kind="mergesort")
    for here in range(len(order)):
        later = here + 1
        while later < len(order) and middle_y[order[later]] - middle_y[order[here]] < _SAME_PX:
            a, b = min(order[here], order[later]), max(order[here], order[later])
            if first[a] and abs(middle_x[a] - middle_x[b]) < _SAME_PX:
                first[b] &= not _alike(corners_px[a], corners_px[b])
            later += 1
    return first


@njit(cache=True, nogil=True)
def _alike(a: Array, b: Array) -> bool:
    for turn in range(4):
        apart = 0.0
        for k in range(4):
            to = (k + turn) % 4
            apart = max(apart, abs(a[k, 0] - b[to, 0]), abs(a[k, 1] - b[to, 1]))
        if apart < _SAME_PX:
            return True
    return False

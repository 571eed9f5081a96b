"""Which runs belong together, and which of these components may be a marker's outline.

Union and find over runs: a run joins those of the row above that touch it. A root is the first run
of its component in reading order.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from tagmetry.detect.segment.runs import Int32s

_THINNEST = 0.7  # an outline's least area, as a share of half of the way around its box
_FLATTEST = 0.12  # height of a box by its width, or the reverse


@njit(cache=True, nogil=True)
def joined(first: Int32s, begins: Int32s, ends: Int32s) -> Int32s:
    """Return the root of each run, shape (n,); pixels must share a side to belong together.

    Args:
        first: Index of the first run of each row, shape (rows + 1,).
        begins: First column of each run.
        ends: Column after the last of each run.
    """
    parent = np.arange(begins.size).astype(np.int32)
    for row in range(1, first.size - 1):
        above, last_above = first[row - 1], first[row]
        for here in range(first[row], first[row + 1]):
            while above < last_above and ends[above] <= begins[here]:
                above += 1
            touching = above
            while touching < last_above and begins[touching] < ends[here]:
                _unite(parent, here, touching)
                touching += 1
    for run in range(parent.size):
        parent[run] = parent[parent[run]]
    return parent


@njit(cache=True, nogil=True)
def _unite(parent: Int32s, a: int, b: int) -> None:
    """Give both runs the same root, the earlier of their two."""
    while parent[a] != a:
        parent[a] = parent[parent[a]]
        a = parent[a]
    while parent[b] != b:
        parent[b] = parent[parent[b]]
        b = parent[b]
    parent[max(a, b)] = min(a, b)


@njit(cache=True, nogil=True)
def likely(
    first: Int32s, begins: Int32s, ends: Int32s, roots: Int32s, least_px: float
) -> NDArray[np.int32]:
    """Return the components that are large, full and wide enough for a square.

    Returns:
        Of each: column and row of its first pixel, width and height of its box, shape (n, 4).
    """
    left, right = begins.copy(), ends.copy()
    top = np.empty(begins.size, np.int32)
    bottom, area = np.zeros(begins.size, np.int32), np.zeros(begins.size, np.int32)
    for row in range(first.size - 1):
        for run in range(first[row], first[row + 1]):
            root = roots[run]
            top[run] = row
            left[root] = min(left[root], begins[run])
            right[root] = max(right[root], ends[run])
            bottom[root] = row + 1
            area[root] += ends[run] - begins[run]
    found = np.empty((begins.size, 4), np.int32)
    count = 0
    for run in range(begins.size):
        width, height = right[run] - left[run], bottom[run] - top[run]
        if roots[run] == run and _may_be_a_square(width, height, area[run], least_px):
            found[count, 0], found[count, 1] = begins[run], top[run]
            found[count, 2], found[count, 3] = width, height
            count += 1
    return found[:count]


@njit(cache=True, nogil=True)
def _may_be_a_square(width: int, height: int, area: int, least_px: float) -> bool:
    longer, shorter = max(width, height), min(width, height)
    large = longer >= least_px and shorter >= _FLATTEST * longer and shorter >= 0.5 * least_px
    return large and area >= _THINNEST * (width + height)

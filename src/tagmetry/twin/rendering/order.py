"""In which order sheets are painted: the farther before the nearer.

A sheet is painted before another if it lies wholly behind the other's plane, or the other wholly
in front of its own (Newell, Newell and Sancha, 1972). In one plane the order of the scene counts;
where neither holds, the distance. Sheets that cross each other are not cut.
"""

import numpy as np

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_FLAT = 1e-7  # of the sheets' distance: nearer to a plane than that is in it


def painting_order(corners: Array, boxes: Array) -> list[int]:
    """Return the sheets' numbers, first what is painted first.

    Args:
        corners: Of n sheets that face the camera, shape (n, 4, 3), camera frame, metres.
        boxes: What they can cover of the image: left, top, right, bottom, shape (n, 4).
    """
    distances_m = np.linalg.norm(corners.mean(axis=1), axis=-1)
    waits_for = _waits_for(corners) & _overlap(boxes)
    waiting = waits_for.sum(axis=1)
    left = np.ones(len(corners), dtype=np.bool_)
    order: list[int] = []
    while left.any():
        free = left & (waiting == 0)
        among = np.flatnonzero(free if free.any() else left)  # none is free in a ring of overlaps
        order.append(int(among[np.argmax(distances_m[among])]))
        left[order[-1]] = False
        waiting -= waits_for[:, order[-1]]
    return order


def _overlap(boxes: Array) -> BoolArray:
    low, high = boxes[:, :2], boxes[:, 2:]
    return np.asarray((low[:, None] < high[None]).all(-1) & (low[None] < high[:, None]).all(-1))


def _waits_for(corners: Array) -> BoolArray:
    """Say for every pair (i, j) whether i is painted only after j."""
    behind, in_front = _sides(corners)
    may_go_first = behind | in_front.T
    in_one_plane = behind & behind.T & in_front & in_front.T
    listed_later = np.tri(len(corners), k=-1, dtype=np.bool_)
    return np.asarray((may_go_first.T & ~may_go_first) | (in_one_plane & listed_later))


def _sides(corners: Array) -> tuple[BoolArray, BoolArray]:
    """Say for every pair (i, j) whether i lies wholly behind, or in front of, the plane of j."""
    across, down = corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0]
    normals = np.cross(down, across)  # toward the viewer: corners go clockwise
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-300)
    height = np.einsum("ikx,jx->ijk", corners, normals)
    height -= np.sum(corners[:, 0] * normals, axis=-1)[None, :, None]
    flat = _FLAT * np.linalg.norm(corners, axis=-1).max(initial=0.0)
    return (height <= flat).all(axis=-1), (height >= -flat).all(axis=-1)

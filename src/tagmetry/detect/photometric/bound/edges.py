"""How the whiteness of pixels changes with a marker's corners and with the blur.

Summed over short pieces of edges, and over moments of the exposure.
"""

import numpy as np

from tagmetry.detect.photometric.bound.seen import Print, Window
from tagmetry.geometry import Array, apply_homography, square_to_quad

_PIECES = 24  # per side of a cell


def by_edges(window: Window, seen: Print) -> tuple[Array, Array]:
    """Return the derivatives of the p pixels' whiteness.

    Returns:
        By the corners (x0, y0, x1, ...), shape (p, 8), and by the blur's covariance (xx, xy, yy),
        shape (p, 3).
    """
    at, to_white = _edges(seen)
    x, moved = _moved_by_corners(window.H, at)
    normal_px = _normals_px(window.H, at, to_white) / (_PIECES * seen.side_cells)
    strength = -np.einsum("ek,ekc->ec", normal_px, moved)
    parts = [
        _at_moment(window, x + shift, normal_px, strength, seen.spread_px)
        for shift in seen.shifts_px
    ]
    by_corners, by_blur = (sum(part) / len(parts) for part in zip(*parts, strict=True))
    return np.asarray(by_corners), np.asarray(by_blur)


def edge_px(window: Window, seen: Print) -> float:
    """Return the length of all edges of the picture in the image."""
    at, to_white = _edges(seen)
    normal_px = _normals_px(window.H, at, to_white) / (_PIECES * seen.side_cells)
    return float(np.linalg.norm(normal_px, axis=1).sum())


def _at_moment(
    window: Window, x: Array, normal_px: Array, strength: Array, spread_px: float
) -> tuple[Array, Array]:
    """Return the derivatives while the pieces of edges are at x, shape (e, 2)."""
    columns, rows = (np.arange(size) for size in window.size_px)
    off_x, off_y = columns - x[:, :1], rows - x[:, 1:]
    bell_x, bell_y = (np.exp(-0.5 * (d / spread_px) ** 2) for d in (off_x, off_y))
    area = 2 * np.pi * spread_px**2
    by_corners = np.stack([(bell_y * s[:, None]).T @ bell_x for s in strength.T], axis=-1) / area
    slope_x, slope_y = -off_x * bell_x / spread_px**2, -off_y * bell_y / spread_px**2
    n_x, n_y = normal_px[:, :1], normal_px[:, 1:]
    by_xx, by_yy = (bell_y * n_x).T @ slope_x, (slope_y * n_y).T @ bell_x
    by_xy = (slope_y * n_x).T @ bell_x + (bell_y * n_y).T @ slope_x
    by_blur = np.stack([by_xx, by_xy, by_yy], axis=-1) / (-2 * area)
    return by_corners.reshape(-1, 8), -by_blur.reshape(-1, 3)


def _edges(seen: Print) -> tuple[Array, Array]:
    """Return pieces of edges: middles and unit vectors toward white, both (e, 2), in sides."""
    cells = np.pad(seen.picture, 1, constant_values=True).astype(int)
    side, first = seen.side_cells, seen.margin_cells + 1
    share = (np.arange(_PIECES) + 0.5) / _PIECES
    at, to_white = [], []
    for axis in (0, 1):  # edges between rows, between columns
        change = np.diff(cells, axis=axis)
        for row, column in np.argwhere(change != 0):
            line = np.full(_PIECES, (row, column)[axis] + 1.0)
            along = (column, row)[axis] + share
            place = np.stack([along, line] if axis == 0 else [line, along], axis=1)
            at.append((place - first) / side)
            toward = np.eye(2)[1 - axis] * change[row, column]
            to_white.append(np.tile(toward, (_PIECES, 1)))
    return np.concatenate(at), np.concatenate(to_white)


def _normals_px(H: Array, at: Array, to_white: Array) -> Array:
    """Return normals of edges toward white, as long as a unit of the square is there, (e, 2)."""
    x = apply_homography(H, at)
    along = apply_homography(H, at + 1e-6 * to_white[:, ::-1] * [1, -1]) - x
    normal_px = 1e6 * np.stack([-along[:, 1], along[:, 0]], axis=1)
    inward = (apply_homography(H, at + 1e-6 * to_white) - x) * normal_px
    return np.asarray(normal_px * np.sign(inward.sum(axis=1, keepdims=True)))


def _moved_by_corners(H: Array, at: Array) -> tuple[Array, Array]:
    """Return where places of the square are, (e, 2), and their derivatives by corners (e, 2, 8)."""
    corners = apply_homography(H, np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]]))
    moved = np.empty((len(at), 2, 8))
    for k in range(8):
        shift = np.zeros(8)
        shift[k] = 1e-4
        ahead, behind = (square_to_quad(corners + s * shift.reshape(4, 2)) for s in (1, -1))
        moved[:, :, k] = (apply_homography(ahead, at) - apply_homography(behind, at)) / 2e-4
    return apply_homography(H, at), moved

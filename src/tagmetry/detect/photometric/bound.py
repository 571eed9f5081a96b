"""How well can corners be known at all? The Cramer-Rao bound of a whole marker's picture.

When corners move, the blurred picture changes along the edges of its cells only: with G the blur's
Gaussian (the pixel's own square in it), n the normal of an edge from black to white at x,

    d white(p) / d corner = - integral over all edges of G(p - x) n . dx/dcorner dx
    d white(p) / d blur   = - blur * integral over all edges of n . grad G(p - x) dx

summed here over short pieces of edges. The levels of black and white, the blur, and a response
exponent are not known beforehand either. The noise is white, its deviation the same everywhere.

This shares no formula with the fit that it judges.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from tagmetry.geometry import Array, apply_homography, square_to_quad
from tagmetry.geometry.arrays import BoolArray

_PIECES = 24  # per side of a cell
_FINER = 4  # samples per pixel where the whiteness itself is wanted
_MARGIN_PX = 6


@dataclass(frozen=True)
class Print:
    """A marker's picture and how it is seen.

    Attributes:
        picture: Cells, True is white, shape (m, m).
        margin_cells: How many cells of it lie outside the square whose corners are meant.
        black: Grey value of black.
        white: Grey value of white.
        blur_px: Standard deviation of the point spread, besides the pixel's own square.
        exponent: Values are those of light to the power 1 / exponent.
    """

    picture: BoolArray
    margin_cells: int
    black: float
    white: float
    blur_px: float
    exponent: float = 1.0


def corner_bound_px2(corners_px: Array, seen: Print, noise: float) -> Array:
    """Return the least covariance of the corners (x0, y0, x1, ...), shape (8, 8).

    Args:
        corners_px: Where they are, shape (4, 2).
        seen: The marker.
        noise: Standard deviation of the grey values' noise.
    """
    low = np.floor(corners_px.min(axis=0)) - _reach_px(corners_px, seen)
    size = np.ceil(corners_px.max(axis=0) - low).astype(int) + _reach_px(corners_px, seen)
    H = square_to_quad(corners_px - low)
    spread_px = np.hypot(seen.blur_px, np.sqrt(1 / 12))
    by_corners, by_blur = _by_edges(H, seen, size, spread_px)
    white = _whiteness(H, seen, size, spread_px)
    levels, slope = _by_levels(white, seen)
    J = np.concatenate([slope[:, None] * np.c_[by_corners, by_blur], levels], axis=1)
    return np.asarray(np.linalg.inv(J.T @ J / noise**2)[:8, :8])


def corner_bound_px(corners_px: Array, seen: Print, noise: float) -> float:
    """Return the least root mean square error of a corner's coordinate; see `corner_bound_px2`."""
    return float(np.sqrt(np.trace(corner_bound_px2(corners_px, seen, noise)) / 8))


def _reach_px(corners_px: Array, seen: Print) -> int:
    side_px = np.ptp(corners_px, axis=0).max()
    cells = len(seen.picture) - 2 * seen.margin_cells
    return int(_MARGIN_PX + np.ceil((seen.margin_cells + 1) * side_px / cells))


def _by_edges(H: Array, seen: Print, size: Array, spread_px: float) -> tuple[Array, Array]:
    """Return the derivatives of the whiteness by the corners (p, 8) and by the blur (p,)."""
    at, to_white = _edges(seen)
    x, moved = _moved_by_corners(H, at)
    along = apply_homography(H, at + 1e-6 * to_white[:, ::-1] * [1, -1]) - x
    normal_px = 1e6 * np.stack([-along[:, 1], along[:, 0]], axis=1)  # per unit of the square
    inward = (apply_homography(H, at + 1e-6 * to_white) - x) * normal_px
    normal_px *= np.sign(inward.sum(axis=1, keepdims=True))
    length = 1 / (_PIECES * (len(seen.picture) - 2 * seen.margin_cells))
    strength = -length * np.einsum("ek,ekc->ec", normal_px, moved)
    columns, rows = np.arange(size[0]), np.arange(size[1])
    off_x, off_y = columns - x[:, :1], rows - x[:, 1:]
    bell_x, bell_y = (np.exp(-0.5 * (d / spread_px) ** 2) for d in (off_x, off_y))
    area = 2 * np.pi * spread_px**2
    by_corners = np.einsum("ec,ey,ex->yxc", strength, bell_y, bell_x, optimize=True) / area
    slope_x, slope_y = (-length * normal_px[:, k, None] / spread_px for k in (0, 1))
    by_blur = bell_y.T @ (slope_x * -off_x * bell_x) + (slope_y * -off_y * bell_y).T @ bell_x
    return by_corners.reshape(-1, 8), -by_blur.ravel() / area


def _edges(seen: Print) -> tuple[Array, Array]:
    """Return pieces of edges: middles and unit vectors toward white, both (e, 2), in sides."""
    cells = np.pad(seen.picture, 1, constant_values=True).astype(int)
    side, first = len(seen.picture) - 2 * seen.margin_cells, seen.margin_cells + 1
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


def _whiteness(H: Array, seen: Print, size: Array, spread_px: float) -> Array:
    """Return how white each pixel is, 0 to 1, shape (p,), from samples within pixels."""
    fine: Array = (np.arange(_FINER * size.max()) + 0.5) / _FINER - 0.5
    x, y = np.meshgrid(fine[: _FINER * int(size[0])], fine[: _FINER * int(size[1])])
    samples: Array = np.stack([x, y], axis=-1).reshape(-1, 2)
    places = apply_homography(np.asarray(np.linalg.inv(H)), samples)
    side = len(seen.picture) - 2 * seen.margin_cells
    cell = np.floor(places * side).astype(int) + seen.margin_cells
    on = np.asarray(((cell >= 0) & (cell < len(seen.picture))).all(axis=1))
    column, row = np.where(on[:, None], cell, 0).T
    white = np.where(on, seen.picture[row, column], 1.0).reshape(x.shape)
    blurred = gaussian_filter(white, spread_px * _FINER, mode="nearest")
    means = blurred.reshape(size[1], _FINER, size[0], _FINER).mean(axis=(1, 3))
    return np.asarray(means.ravel())


def _by_levels(white: Array, seen: Print) -> tuple[Array, Array]:
    """Return the values' derivatives by black, white (and the exponent), and by the whiteness."""
    power = seen.exponent
    low, high = seen.black**power, seen.white**power
    light = low + (high - low) * white
    value = light ** (1 / power)
    by_light = value / (power * light)
    by_black = by_light * (1 - white) * power * low / seen.black
    by_white = by_light * white * power * high / seen.white
    columns = [by_black, by_white]
    if power != 1.0:
        by_low = low * np.log(seen.black) * (1 - white) + high * np.log(seen.white) * white
        columns.append(by_light * by_low - value * np.log(light) / power**2)
    return np.stack(columns, axis=1), by_light * (high - low)

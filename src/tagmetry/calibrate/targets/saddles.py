"""Where exactly are the corners of a chessboard? Each is fitted as a blurred crossing of two edges.

Around a corner c the picture is

    I(p) = a + b erf(n1 . (p - c) / (sqrt(2) s)) erf(n2 . (p - c) / (sqrt(2) s)),

two straight edges with unit normals n1 and n2, a mean grey a, half the contrast b and a blur s (in
pixels, the pixel's own area included). All seven unknowns are fitted to the raw pixels by
Levenberg-Marquardt, all corners at once; the covariance of c follows from the residuals. Whatever
is the same on both sides of c, such as spread ink or a camera's gamma curve, does not move c.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import erf

from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_STEPS = 15
_LARGEST_HALF_PX = 16.0  # beyond, a lens' curves cost more than longer edges give
_LEAST_HALF_PX = 2.0
_FLOOR_PX = 0.0008  # what the model leaves out, on noiseless rendered boards
_SHARP_SD_PX = 0.02  # with no blur at all, as a pixel's square is no Gaussian
_PIXEL_PX, _SOFT_PX = 0.29, 0.42  # blur of a pixel alone, and from which on it looks Gaussian
_UNKNOWNS = 7
_SETTLED = 1e-3
_QUANTUM = 1 / np.sqrt(12)  # standard deviation of rounding to whole grey values


@dataclass(frozen=True, eq=False)
class Saddles:
    """The fitted corners.

    Attributes:
        centres_px: Shape (n, 2).
        sd_px: Standard deviation along an axis, shape (n,).
        blur_px: Standard deviation of the edges' blur, shape (n,).
        contrast: White minus black, grey values, shape (n,).
        noise: Standard deviation of what the model leaves, grey values, shape (n,).
        is_saddle: Whether the fit is one that could be meant, shape (n,); the rest is not to be
            used.
    """

    centres_px: Array
    sd_px: Array
    blur_px: Array
    contrast: Array
    noise: Array
    is_saddle: BoolArray


@dataclass(frozen=True, eq=False)
class _Window:
    """The pixels around n corners: places from the guess (n, k), grey values and use (n, k)."""

    x: Array
    y: Array
    grey: Array
    used: Array


def fit_saddles(
    grey: GreyPixels,
    guesses_px: Array,
    along_px: Array,
    down_px: Array,
    half: float = 1 / 3,
    arm: float = 1.0,
) -> Saddles:
    """Fit corners between squares.

    Args:
        grey: 8-bit image, shape (height, width).
        guesses_px: Where the corners are about, shape (n, 2).
        along_px: From each to the next corner in its row, shape (n, 2).
        down_px: From each to the next corner in its column, shape (n, 2).
        half: Half the window's side, as a share of these steps.
        arm: Only pixels this close to an edge, as a share of the steps, are looked at; the rest may
            hold a marker.
    """
    steps_px = np.stack([along_px, down_px], axis=-1)
    window = _gather(grey, guesses_px, steps_px, half, arm)
    unknowns = _fit(window, _start(window, steps_px))
    return _judged(window, unknowns, guesses_px, steps_px)


def _gather(
    grey: GreyPixels, guesses_px: Array, steps_px: Array, half: float, arm: float
) -> _Window:
    middle = np.rint(guesses_px).astype(np.int64)
    shortest_px = np.linalg.norm(steps_px, axis=1)  # of (along, down) each
    limits = np.clip(half, _LEAST_HALF_PX / shortest_px, _LARGEST_HALF_PX / shortest_px)
    reach = np.abs(steps_px * limits[:, None, :]).sum(axis=2).max()
    offsets = np.arange(-int(np.ceil(reach)), int(np.ceil(reach)) + 1)
    dx, dy = (d.ravel() for d in np.meshgrid(offsets, offsets))
    column, row = middle[:, :1] + dx, middle[:, 1:] + dy
    height_px, width_px = grey.shape
    inside = (column >= 0) & (column < width_px) & (row >= 0) & (row < height_px)
    x, y = column - guesses_px[:, :1], row - guesses_px[:, 1:]
    u, v = np.moveaxis(np.linalg.inv(steps_px) @ np.stack([x, y], axis=1), 1, 0)
    used = inside & (np.abs(u) <= limits[:, :1]) & (np.abs(v) <= limits[:, 1:])
    used &= np.minimum(np.abs(u), np.abs(v)) <= arm
    values = grey[np.clip(row, 0, height_px - 1), np.clip(column, 0, width_px - 1)]
    return _compressed(_Window(x, y, values.astype(np.float64), used.astype(np.float64)))


def _compressed(window: _Window) -> _Window:
    """Leave out pixels that are not used, as far as the corner that uses most allows."""
    most = int(window.used.sum(axis=1).max())
    kept = np.argsort(-window.used, axis=1, kind="stable")[:, :most]
    parts = (window.x, window.y, window.grey, window.used)
    return _Window(*(np.take_along_axis(part, kept, axis=1) for part in parts))


def _start(window: _Window, steps_px: Array) -> Array:
    """Return first unknowns (n, 7): centre, directions of the normals, log blur, mean, contrast."""
    along, down = steps_px[..., 0], steps_px[..., 1]
    shortest_px = np.linalg.norm(steps_px, axis=1).min(axis=1)
    start = np.zeros((len(steps_px), _UNKNOWNS))
    start[:, 2] = np.arctan2(along[:, 0], -along[:, 1])
    start[:, 3] = np.arctan2(down[:, 0], -down[:, 1])
    start[:, 4] = np.log(np.clip(0.06 * shortest_px, 0.7, 4.0))
    start[:, 6] = 1.0
    pattern = _picture(window, start)[0] * window.used
    count = np.maximum(window.used.sum(axis=1), 1.0)
    mean = (window.used * window.grey).sum(axis=1) / count
    start[:, 5] = mean
    contrast = (pattern * (window.grey - mean[:, None])).sum(axis=1)
    start[:, 6] = contrast / np.maximum((pattern**2).sum(axis=1), 1e-9)
    return start


def _picture(window: _Window, unknowns: Array) -> tuple[Array, Array]:
    """Return the model's grey values (n, k) and their derivatives (n, k, 7)."""
    cx, cy, turn1, turn2, log_blur, mean, half_contrast = unknowns.T[..., None]
    x, y, blur = window.x - cx, window.y - cy, np.exp(log_blur)
    edge1, slope1, across1, along1 = _edge(x, y, turn1, blur)
    edge2, slope2, across2, along2 = _edge(x, y, turn2, blur)
    by1, by2 = half_contrast * slope1 * edge2, half_contrast * edge1 * slope2
    derivatives = (
        -by1 * np.cos(turn1) - by2 * np.cos(turn2),
        -by1 * np.sin(turn1) - by2 * np.sin(turn2),
        by1 * along1,
        by2 * along2,
        -by1 * across1 - by2 * across2,
        np.ones_like(x),
        edge1 * edge2,
    )
    return mean + half_contrast * edge1 * edge2, np.stack(derivatives, axis=-1)


def _edge(x: Array, y: Array, turn: Array, blur: Array) -> tuple[Array, Array, Array, Array]:
    """Return a blurred edge, its slope, and the distances across and along it."""
    across, along = np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x
    slope = np.sqrt(2 / np.pi) / blur * np.exp(-0.5 * (across / blur) ** 2)
    return erf(across / (np.sqrt(2) * blur)), slope, across, along


def _fit(window: _Window, unknowns: Array) -> Array:
    """Go downhill, each corner with its own damping."""
    damping = np.full(len(unknowns), 1e-2)
    picture, derivatives = _picture(window, unknowns)
    cost = _cost(window, picture)
    for _ in range(_STEPS):
        gradient, curvature = _normal_equations(window, picture, derivatives)
        diagonal = np.einsum("nii->ni", curvature)
        damped = curvature + (damping[:, None] * diagonal + 1e-9)[..., None] * np.eye(_UNKNOWNS)
        moved = unknowns + np.linalg.solve(damped, gradient[..., None])[..., 0]
        moved[:, 4] = np.clip(moved[:, 4], np.log(0.2), np.log(20.0))
        new_picture, new_derivatives = _picture(window, moved)
        new_cost = _cost(window, new_picture)
        better, unknowns_before = new_cost < cost, unknowns
        unknowns = np.where(better[:, None], moved, unknowns)
        cost = np.where(better, new_cost, cost)
        picture = np.where(better[:, None], new_picture, picture)
        derivatives = np.where(better[:, None, None], new_derivatives, derivatives)
        damping = np.where(better, damping / 5, damping * 5)
        settled = np.abs(moved - unknowns_before).max(axis=1) < _SETTLED
        if settled.all():
            break
    return unknowns


def _cost(window: _Window, picture: Array) -> Array:
    return np.asarray((window.used * (window.grey - picture) ** 2).sum(axis=1))


def _normal_equations(window: _Window, picture: Array, derivatives: Array) -> tuple[Array, Array]:
    J = derivatives * window.used[..., None]
    residual = window.grey - picture
    return np.einsum("nkp,nk->np", J, residual), np.swapaxes(J, 1, 2) @ J


def _judged(window: _Window, unknowns: Array, guesses_px: Array, steps_px: Array) -> Saddles:
    """Say how certain each corner is, and which are none."""
    picture, derivatives = _picture(window, unknowns)
    _, curvature = _normal_equations(window, picture, derivatives)
    freedom = np.maximum(window.used.sum(axis=1) - _UNKNOWNS, 1.0)
    noise = np.sqrt(_cost(window, picture) / freedom + _QUANTUM**2 / freedom)
    solvable = np.linalg.cond(curvature) < 1e14
    safe = np.where(solvable[:, None, None], curvature, np.eye(_UNKNOWNS))
    variance = np.einsum("nii->ni", np.linalg.inv(safe))[:, :2].mean(axis=1) * noise**2
    blur_px, contrast = np.exp(unknowns[:, 4]), 2 * np.abs(unknowns[:, 6])
    shortest_px = np.linalg.norm(steps_px, axis=1).min(axis=1)
    is_saddle = (
        solvable
        & (window.used.sum(axis=1) > 2 * _UNKNOWNS)
        & (contrast > np.maximum(6.0, 4 * noise))
        & (blur_px < 0.4 * shortest_px)
    )
    sharp = np.clip((_SOFT_PX - blur_px) / (_SOFT_PX - _PIXEL_PX), 0.0, 1.0)
    floor_px = _FLOOR_PX + _SHARP_SD_PX * sharp
    sd_px = np.sqrt(np.maximum(variance, 0.0) + floor_px**2)
    centres_px = guesses_px + unknowns[:, :2]
    return Saddles(centres_px, sd_px, blur_px, contrast, noise, np.asarray(is_saddle))

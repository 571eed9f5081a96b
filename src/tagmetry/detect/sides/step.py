"""A blurred step fitted to the pixels around each side.

Around a side the image is modelled as

    I(p) = black(u) + contrast(u) * Phi((d(p) - offset - turn * u - bow * (u^2 - 1)) / blur)

with d the distance of pixel p from the side's first guess (outward positive), u in -1..1 along it,
black and contrast linear in u, and Phi the Gaussian's integral: eight numbers per side, found by
Gauss and Newton with weights against dirt. Offset and turn say where the side's ends are. The
covariance is that of the fit, with the noise taken from its residuals.
"""

import numpy as np
from scipy.special import ndtr

from tagmetry.detect.sides.window import Window
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray

_ITERATIONS = 10
_BLUR_PX = (0.35, 4.0)


def fit_steps(window: Window) -> tuple[Array, Array, BoolArray]:
    """Fit all sides: numbers (s, 8), covariances of the first three (s, 3, 3), which are sound."""
    fit = _first_fit(window)
    weight = window.weight
    for _ in range(_ITERATIONS):
        model, jacobian = _model(fit, window)
        residual = window.values - model
        weight = window.weight * _trust(residual, window.weight)
        step, _ = _solved(jacobian, residual, weight)
        fit = _limited(fit + step * _shortening(step))
    model, jacobian = _model(fit, window)
    residual = window.values - model
    _, inverse = _solved(jacobian, residual, weight)
    freedom = weight.sum(axis=1) - fit.shape[1]
    noise2 = (weight * residual**2).sum(axis=1) / np.maximum(freedom, 1)
    sound = (freedom >= 12) & np.isfinite(fit).all(axis=1)
    sound &= np.abs(fit[:, 5]) > 3 * np.sqrt(noise2)
    return fit, noise2[:, None, None] * inverse[:, :3, :3], sound


def _shortening(step: Array) -> Array:
    """Return factors that keep a step within a pixel of offset, turn and bow."""
    return np.asarray(1 / np.maximum(1.0, np.abs(step[:, :3]).max(axis=1, keepdims=True)))


def _first_fit(window: Window) -> Array:
    """Start from the mean grey inside and outside."""
    inside = window.weight * (window.distance_px < 0)
    outside = window.weight * (window.distance_px > 0)
    dark = (inside * window.values).sum(axis=1) / np.maximum(inside.sum(axis=1), 1)
    bright = (outside * window.values).sum(axis=1) / np.maximum(outside.sum(axis=1), 1)
    zero = np.zeros_like(dark)
    return np.stack([zero, zero, zero, dark, zero, bright - dark, zero, zero + 0.8], axis=1)


def _model(fit: Array, window: Window) -> tuple[Array, Array]:
    """Return the modelled values (s, m) and their derivatives (s, m, 8)."""
    offset, turn, bow, black, black_u, contrast, contrast_u, blur = (c[:, None] for c in fit.T)
    u, arch = window.u, window.arch
    z = (window.distance_px - offset - turn * u - bow * arch) / blur
    step, bell = ndtr(z), np.exp(-0.5 * z * z) / np.sqrt(2 * np.pi)
    height = contrast + contrast_u * u
    by_offset = -height * bell / blur
    by_line = [by_offset, by_offset * u, by_offset * arch]
    jacobian = np.stack([*by_line, np.ones_like(u), u, step, step * u, by_offset * z], axis=2)
    return black + black_u * u + height * step, jacobian


def _trust(residual: Array, used: Array) -> Array:
    """Return Cauchy's weights, with the noise taken from the median residual."""
    ordered = np.sort(np.where(used > 0, np.abs(residual), np.inf), axis=1)
    middle = np.maximum(used.sum(axis=1).astype(int) // 2, 0)
    noise = np.take_along_axis(ordered, middle[:, None], axis=1) / 0.6745
    noise = np.where(np.isfinite(noise), np.maximum(noise, 0.3), 1.0)
    return 1 / (1 + (residual / (4 * noise)) ** 2)


def _solved(jacobian: Array, residual: Array, weight: Array) -> tuple[Array, Array]:
    """Return the steps (s, 8) and the inverses of the normal matrices (s, 8, 8)."""
    weighted = jacobian * weight[..., None]
    normal = np.swapaxes(weighted, 1, 2) @ jacobian
    scale = np.sqrt(np.maximum(np.einsum("sii->si", normal), 1e-12))
    scaled = normal / scale[:, :, None] / scale[:, None, :] + 1e-9 * np.eye(8)
    inverse = np.linalg.inv(scaled) / scale[:, :, None] / scale[:, None, :]
    right = np.einsum("smk,sm->sk", weighted, residual)
    return np.einsum("skl,sl->sk", inverse, right), inverse


def _limited(fit: Array) -> Array:
    line, levels, blur = fit[:, :3], fit[:, 3:7], fit[:, 7:]
    return np.concatenate([np.clip(line, -8, 8), levels, np.clip(blur, *_BLUR_PX)], axis=1)

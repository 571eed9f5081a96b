"""The camera between calibrated ones: the rays of pixels are interpolated, not the coefficients.

Coefficients of a lens are strongly correlated, and in the rational model quite different ones bend
rays alike: a blend of them may be neither. So each calibration is turned into a map from pixels to
viewing rays; between neighbours every ray follows a monotone cubic (PCHIP; Fritsch and Carlson,
1980); and the camera of the model that has these rays is fitted.

A ray is written as q (`charts`). With P the projection, A = dP / d(parameters) and B = dP / dq:

    q* = sum w_k q_k          w_k: the derivative of the cubic by its k-th value
    d(parameters*) = A*^+ B* sum w_k B_k^-1 A_k d(parameters_k)
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.camera.bank.charts import by_chart, chart, points_on, ray_jacobian
from tagmetry.camera.bank.parameters import parameters, pixel_grid, with_parameters
from tagmetry.camera.model import Camera
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import Array, BoolArray

_STEPS = 20
_DONE_PX = 1e-8
_UNSEEN = 1e-7  # relative strength at which a direction of the parameters moves no pixel


def camera_between(cameras: Sequence[Camera], settings: Array, setting: float) -> Camera:
    """Return the camera at a setting between calibrated ones.

    Args:
        cameras: Of one image size and lens model, with equally many coefficients; at least 2.
        settings: Theirs, strictly ascending, shape (n,).
        setting: Within their range.

    Returns:
        The camera with a covariance, independent errors of the calibrations presumed, where all
        calibrations that have a say have one. Zoom, focus and name are those of the nearest.

    Raises:
        InputError: The calibrations share too few rays.
    """
    near = _having_a_say(settings, setting)
    cameras, settings = cameras[near], settings[near]
    pixels = pixel_grid(cameras[0])
    maps = np.stack([chart(camera.unproject(pixels)) for camera in cameras])
    seen = np.asarray(np.isfinite(maps).all(axis=(0, 2)))
    _check_seen(cameras, seen)
    maps, pixels = maps[:, seen], pixels[seen]
    nearest = cameras[int(np.abs(settings - setting).argmin())]
    q = _cubic(settings, maps, setting)
    camera = _fitted(nearest, q, pixels)
    if any(each.covariance is None for each in cameras):
        return camera
    weights = _cubic_weights(settings, maps, setting)
    return replace(camera, covariance=_covariance(camera, cameras, q, weights, maps))


def re_expressed(camera: Camera, like: Camera) -> Camera:
    """Return the camera with the coefficients next to those of another that bend rays as its do.

    Args:
        camera: With a covariance or without; both of one lens model and parameter count.
        like: Whose coefficients to stay near.
    """
    pixels = pixel_grid(camera)
    q = chart(camera.unproject(pixels))
    seen = np.asarray(np.isfinite(q).all(axis=-1))
    _check_seen([camera], seen)
    found = _fitted(like, q[seen], pixels[seen])
    if camera.covariance is None:
        return found
    maps = q[None, seen]
    covariance = _covariance(found, [camera], q[seen], np.ones_like(maps), maps)
    return replace(found, covariance=covariance)


def carried_errors(camera: Camera, errors_px: Array) -> Array:
    """Return the parameter changes that displace the rays of the pixel grid so.

    Args:
        camera: Where.
        errors_px: Displacements over the pixel grid, shape (k, n, 2); NaN counts as none.

    Returns:
        Shape (k, 4 + coefficients).
    """
    jacobian, seen = _parameter_jacobian(camera, camera.unproject(pixel_grid(camera)))
    errors_px = np.nan_to_num(errors_px[:, seen]).reshape(len(errors_px), len(jacobian))
    return np.asarray(errors_px @ _pseudo_inverse(jacobian).T)


def _check_seen(cameras: Sequence[Camera], seen: BoolArray) -> None:
    if 2 * seen.sum() >= cameras[0].parameter_count:
        return
    foci = ", ".join(f"{camera.focus:g}" for camera in cameras if camera.focus is not None)
    raise InputError(
        f"the distortion of the calibrations at focus {foci} folds over nearly the whole image; "
        "look for a bad one with tagmetry camera show"
    )


def _having_a_say(settings: Array, setting: float) -> slice:
    """Return which neighbours the cubic depends on: two on each side."""
    right = int(np.clip(np.searchsorted(settings, setting), 1, len(settings) - 1))
    return slice(max(0, right - 2), right + 2)


def _cubic(settings: Array, values: Array, setting: float) -> Array:
    """Interpolate values (n, ...) monotonically; a straight line where there are only two."""
    from scipy.interpolate import PchipInterpolator  # slow to import

    return np.asarray(PchipInterpolator(settings, values, axis=0)(setting))


def _cubic_weights(settings: Array, values: Array, setting: float) -> Array:
    """Return d(interpolated) / d(value k), shape as values, by central differences."""
    count = len(settings)
    step = 1e-6 * max(float(np.ptp(values, axis=0).max()), 1e-6)
    steps = step * np.eye(count).reshape(count, count, *[1] * (values.ndim - 1))
    both = np.stack([values[:, None] + steps, values[:, None] - steps], axis=1)
    above, below = _cubic(settings, both, setting)
    return np.asarray((above - below) / (2 * step))


def _fitted(start: Camera, q: Array, pixels: Array) -> Camera:
    """Return the camera that shows the rays at these pixels best, by Levenberg and Marquardt.

    The damping keeps coefficients that hardly move a pixel where they are.
    """
    points, camera, damping = points_on(q), start, 1e-9
    for _ in range(_STEPS):
        jacobian, seen = _parameter_jacobian(camera, points)
        residual = (pixels - camera.project(points))[seen].ravel()
        step = _pseudo_inverse(jacobian, damping) @ residual
        moved = _moved(camera, step)
        if moved is None or _misfit_px(moved, points, pixels) > _misfit_px(camera, points, pixels):
            damping *= 100
            continue
        camera, damping = moved, max(damping / 10, 1e-9)
        if np.abs(jacobian @ step).max(initial=0.0) < _DONE_PX:
            break
    return camera


def _moved(camera: Camera, step: Array) -> Camera | None:
    values = parameters(camera) + step
    usable = np.isfinite(values).all() and min(values[:2]) > 0
    return with_parameters(camera, values) if usable else None


def _misfit_px(camera: Camera, points: Array, pixels: Array) -> float:
    """Return the root mean square distance, infinite where a ray is not shown."""
    squares = ((camera.project(points) - pixels) ** 2).sum(axis=-1)
    return float(np.sqrt(squares.mean())) if np.isfinite(squares).all() else float("inf")


def _covariance(
    camera: Camera, cameras: Sequence[Camera], q: Array, weights: Array, maps: Array
) -> Array:
    """Carry the covariances of cameras to the one fitted to their weighted maps.

    Args:
        camera: What was fitted.
        cameras: The k cameras that its rays come from.
        q: Its rays, shape (n, 2).
        weights: d(q) / d(q_k), shape (k, n, 2).
        maps: Their q_k, shape (k, n, 2).
    """
    jacobian, seen = _parameter_jacobian(camera, points_on(q))
    pixels_by_q = by_chart(camera, points_on(q))[seen]
    solve = _pseudo_inverse(jacobian)
    covariance = np.zeros((camera.parameter_count,) * 2)
    for each, weight, own_q in zip(cameras, weights, maps, strict=True):
        q_by_own = ray_jacobian(each, points_on(own_q))[seen]
        carried = pixels_by_q @ (weight[seen][..., None] * q_by_own)
        by_own = solve @ carried.reshape(-1, camera.parameter_count)
        covariance += by_own @ np.asarray(each.covariance) @ by_own.T
    return covariance


def _parameter_jacobian(camera: Camera, points: Array) -> tuple[Array, BoolArray]:
    """Return d(pixels) / d(parameters), shape (2 m, n), of the m points that the camera shows."""
    jacobian = camera.parameter_jacobian(points)
    seen = np.asarray(np.isfinite(jacobian).all(axis=(-1, -2)))
    return jacobian[seen].reshape(-1, camera.parameter_count), seen


def _pseudo_inverse(jacobian: Array, damping: float = 0.0) -> Array:
    """Return A^+ with columns brought to one length first: focal and k3 differ by 10^3 px.

    Args:
        jacobian: A, shape (m, n).
        damping: Of Levenberg and Marquardt, relative to the largest singular value squared.
    """
    lengths = np.maximum(np.linalg.norm(jacobian, axis=0), 1e-300)
    left, singular, right = np.linalg.svd(jacobian / lengths, full_matrices=False)
    relative = singular / singular[0]
    gains = np.where(relative > _UNSEEN, relative / (relative**2 + damping), 0.0) / singular[0]
    return np.asarray((right.T * gains) @ left.T / lengths[:, None])

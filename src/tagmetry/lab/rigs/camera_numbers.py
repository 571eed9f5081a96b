"""The numbers of a camera that was found, beside the true one's."""

from collections.abc import Iterator

import numpy as np

from tagmetry.camera import Camera

PARAMETERS = ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")


def camera_numbers(found: Camera, true: Camera) -> Iterator[tuple[str, float, float, float]]:
    """Give name, value, true value and stated standard deviation of each; NaN where none is."""
    numbers, covariance = _numbers(found), found.covariance
    sd = np.full(len(numbers), np.nan) if covariance is None else np.sqrt(np.diag(covariance))
    yield from zip(PARAMETERS, numbers, _numbers(true), sd.tolist(), strict=True)


def projection_rms_px(found: Camera, true: Camera, places: tuple[int, int]) -> float:
    """Return how far projections are from the true ones, over all of the image that has rays.

    Args:
        found: The camera that is judged.
        true: The camera that it is judged by.
        places: How many are looked at, along the rows and along the columns.
    """
    sides = zip(true.size_px, places, strict=True)
    u, v = (np.linspace(0, side_px - 1, count) for side_px, count in sides)
    rays = true.unproject(np.stack(np.meshgrid(u, v), axis=-1))
    rays = rays[np.isfinite(rays).all(axis=-1)]
    error = found.project(rays) - true.project(rays)
    return float(np.sqrt(np.nanmean((error**2).sum(axis=-1))))


def _numbers(camera: Camera) -> list[float]:
    return [*camera.focal_px, *camera.center_px, *camera.lens.coefficients]

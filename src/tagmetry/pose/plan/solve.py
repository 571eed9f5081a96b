"""Which size, distance or resolution gives a wanted accuracy.

Values over a wide range are tried, of which those count where the marker fits into the image and is
found; between the last that is good enough and the next, the answer is found by bisection.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import numpy as np

from tagmetry.camera import scaled
from tagmetry.errors import InputError
from tagmetry.pose.plan.predict import position_m, predict
from tagmetry.pose.plan.reach import shortest_side_px
from tagmetry.pose.plan.setup import Setup

Free = Literal["size", "distance", "resolution"]

_TRIED = 33
_CLOSE = 3e-3  # of the value
_WIDEST = 1e3  # times more or less than the distance, or than the size
_MOST_PIXELS = 16.0  # times more or fewer pixels along a side


def solved(setup: Setup, want_m: float, free: Free) -> Setup:
    """Return the setup with the cheapest value of what is free that is exact enough.

    That is the smallest marker, the greatest distance, or the fewest pixels of the same lens, whose
    noise and blur in pixels stay as they are.

    Args:
        setup: What is planned; its own value of what is free does not matter, but for the
            resolution.
        want_m: Root mean square error of the position that is allowed.
        free: What may change.

    Raises:
        InputError: Nothing is exact enough; the text says what comes nearest, and why.
    """
    if not (np.isfinite(want_m) and want_m > 0):
        raise InputError(f"want_m must be positive, got {want_m}")
    tried = _candidates(setup, free)
    first = next((n for n, value in enumerate(tried) if _is_good(setup, free, value, want_m)), None)
    if first is None:
        raise InputError(_refusal(setup, want_m, free, tried))
    too_cheap, good = tried[max(first - 1, 0)], tried[first]
    while abs(np.log(good / too_cheap)) > _CLOSE:
        middle = float(np.sqrt(too_cheap * good))
        if _is_good(setup, free, middle, want_m):
            good = middle
        else:
            too_cheap = middle
    return _with(setup, free, good)


def _candidates(setup: Setup, free: Free) -> list[float]:
    """Return values from the cheapest to the most exact."""
    if free == "size":
        return _between(setup.distance_m / _WIDEST, 2 * setup.distance_m)
    if free == "distance":
        return _between(_WIDEST * setup.size_m, setup.size_m / 2)
    return _between(1 / _MOST_PIXELS, _MOST_PIXELS)


def _between(first: float, last: float) -> list[float]:
    return [float(value) for value in np.geomspace(first, last, _TRIED)]


def _with(setup: Setup, free: Free, value: float) -> Setup:
    if free == "size":
        return replace(setup, size_m=value)
    if free == "distance":
        return replace(setup, distance_m=value)
    camera = setup.camera
    width_px, height_px = (max(1, round(value * size)) for size in camera.size_px)
    pixel = setup.pixel
    if pixel is not None:
        pixel = ((pixel[0] + 0.5) * value - 0.5, (pixel[1] + 0.5) * value - 0.5)
    return replace(setup, camera=scaled(camera, width_px, height_px), pixel=pixel)


def _error_m(setup: Setup) -> float:
    """Return the error of the position; infinite where the marker is not seen whole or found."""
    if not setup.fits or setup.short_side_px < shortest_side_px(setup):
        return np.inf
    return predict(setup).position_m


def _is_good(setup: Setup, free: Free, value: float, want_m: float) -> bool:
    return _error_m(_with(setup, free, value)) <= want_m


def _refusal(setup: Setup, want_m: float, free: Free, tried: Sequence[float]) -> str:
    """Return what comes nearest to what is wanted, and what keeps it from it."""
    errors_m = [_error_m(_with(setup, free, value)) for value in tried]
    best = _with(setup, free, tried[int(np.argmin(errors_m))])
    if not np.isfinite(min(errors_m)):
        return f"no {free} lets the marker be found; take less tilt, motion, blur or noise"
    prediction = predict(best)
    parts = {
        "the noise of its corners": prediction.by_corners,
        "the size's uncertainty": prediction.by_size,
    }
    if prediction.by_calibration is not None:
        parts["the calibration"] = prediction.by_calibration
    worst = max(parts, key=lambda name: position_m(parts[name]))
    return (
        f"no {free} gives {1000 * want_m:g} mm: the best is "
        f"{1000 * prediction.position_m:.3g} mm, of which {worst} makes "
        f"{1000 * position_m(parts[worst]):.3g} mm"
    )

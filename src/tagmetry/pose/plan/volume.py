"""Accuracy over the working volume: the plane through the middle of the image, seen from above."""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.pose.plan.predict import predict
from tagmetry.pose.plan.reach import range_m, shortest_side_px
from tagmetry.pose.plan.setup import Setup

_NEAREST, _FARTHEST = 0.05, 0.999  # of the range
_EDGE = 0.94  # of half the image's width: a marker is wider than a point


@dataclass(frozen=True, eq=False)
class Volume:
    """Errors over a grid of places, rows from near to far, columns from left to right.

    Attributes:
        x_m: To the right of the camera, shape (rows, columns).
        z_m: Before it.
        position_m: Root mean square error of the position; NaN where the marker is not seen whole,
            or is not found.
        flip_probability: That the wrong one of two poses fits better.
    """

    x_m: Array
    z_m: Array
    position_m: Array
    flip_probability: Array


def over_volume(setup: Setup, columns: int = 9, rows: int = 9) -> Volume:
    """Return how exact the position of a marker is all over the image, near and far.

    Args:
        setup: What is planned; its own place does not matter.
        columns: Of the grid.
        rows: Of the grid.

    Raises:
        InputError: The marker is found at no distance.
    """
    far_m = range_m(setup)
    if far_m == 0:
        raise InputError("the marker is found at no distance: less tilt, motion, blur or noise")
    width_px, height_px = setup.camera.size_px
    half_px = (width_px - 1) / 2
    u = half_px * (1 + _EDGE * np.linspace(-1, 1, columns))
    distances_m = far_m * np.geomspace(_NEAREST, _FARTHEST, rows)
    places = [
        [replace(setup, pixel=(pixel, (height_px - 1) / 2), distance_m=d) for pixel in u.tolist()]
        for d in distances_m.tolist()
    ]
    found = np.array([[_expected(one) for one in row] for row in places])
    at = np.array([[one.T_camera_marker.translation for one in row] for row in places])
    return Volume(at[..., 0], at[..., 2], found[..., 0], found[..., 1])


def _expected(setup: Setup) -> tuple[float, float]:
    """Return the error of the position and the probability of a flip; NaN where not found."""
    if not setup.fits or setup.short_side_px < shortest_side_px(setup):
        return np.nan, np.nan
    prediction = predict(setup)
    return prediction.position_m, prediction.flip_probability

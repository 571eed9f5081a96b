"""The centre of darkness of a disc: the first moment of what it takes from a bright ground.

    c = sum p w / sum w,   w(p) = ground(p) - I(p),

over a window that is the disc itself, wider by part of the gap to its neighbours. The ground is a
plane through the window's rim, so that uneven light does not pull. Blur and a gamma curve change w
the same on all sides.
"""

import numpy as np

from tagmetry.geometry import Array, apply_homography
from tagmetry.geometry.arrays import BoolArray, GreyPixels

_ROUNDS = 3
_RIM, _WINDOW = 0.55, 0.9  # shares of the gap to the neighbour's edge: where the rim begins, ends
_LEAST_CONTRAST = 12.0
_FLOOR_PX = 0.001


def disc_centres(
    grey: GreyPixels, circles_m: Array, nearest_m: float, H: Array, guesses_px: Array
) -> tuple[Array, Array, BoolArray]:
    """Return centres (n, 2), standard deviations (n,), pixels, and whether each is a disc (n,).

    Args:
        grey: 8-bit image.
        circles_m: Discs on the board, shape (n, 3): x, y, radius.
        nearest_m: From a disc's centre to the next one's.
        H: From the board's x and y to pixels: says how a window is shaped.
        guesses_px: Where the ellipses' centres are about, shape (n, 2).
    """
    centres, sd_px = np.array(guesses_px), np.full(len(circles_m), np.inf)
    for i, (x_m, y_m, radius_m) in enumerate(circles_m):
        gap_m = nearest_m / 2 - radius_m
        rim = radius_m + _RIM * gap_m, radius_m + _WINDOW * gap_m
        shape = _local_inverse(H, np.array([x_m, y_m]))
        for _ in range(_ROUNDS):
            centres[i], sd_px[i] = _moment(grey, centres[i], shape, rim)
    is_disc = np.isfinite(sd_px) & np.isfinite(centres).all(axis=1)
    is_disc &= np.linalg.norm(centres - guesses_px, axis=1) < 0.25 * _radius_px(circles_m, H) + 1.5
    return centres, np.sqrt(sd_px**2 + _FLOOR_PX**2), np.asarray(is_disc)


def _local_inverse(H: Array, place_m: Array) -> Array:
    """Return metres on the board per pixel around a place, shape (2, 2)."""
    step_m = 1e-6 * max(1e-3, float(np.abs(place_m).max()))
    around = apply_homography(H, place_m + step_m * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]))
    return np.asarray(np.linalg.inv(((around[1:] - around[0]) / step_m).T))


def _radius_px(circles_m: Array, H: Array) -> Array:
    beside = circles_m[:, :2] + circles_m[:, 2:] * np.array([1.0, 0.0])
    radii = apply_homography(H, beside) - apply_homography(H, circles_m[:, :2])
    return np.asarray(np.linalg.norm(radii, axis=1))


def _moment(
    grey: GreyPixels, centre: Array, shape: Array, rim_m: tuple[float, float]
) -> tuple[Array, float]:
    """Return the centre of darkness and its standard deviation, infinite where there is no disc."""
    nothing = centre, np.inf
    reach = np.ceil(rim_m[1] * np.linalg.norm(np.linalg.inv(shape), axis=1)) + 1
    low, high = np.rint(centre - reach).astype(int), np.rint(centre + reach).astype(int) + 1
    if (low < 0).any() or (high > grey.shape[::-1]).any() or reach.max() > 500:
        return nothing
    x, y = np.meshgrid(np.arange(low[0], high[0]), np.arange(low[1], high[1]))
    places = np.stack([x.ravel(), y.ravel()], axis=1) - centre
    values = grey[low[1] : high[1], low[0] : high[0]].ravel().astype(np.float64)
    far_m = np.linalg.norm(places @ shape.T, axis=1)
    inside, on_rim = far_m < rim_m[1], (far_m >= rim_m[0]) & (far_m < rim_m[1])
    if on_rim.sum() < 8:
        return nothing
    return _weighed(places[inside], values[inside], on_rim[inside], centre)


def _weighed(places: Array, values: Array, on_rim: BoolArray, centre: Array) -> tuple[Array, float]:
    plane = np.column_stack([np.ones(len(places)), places])
    to_plane = np.linalg.pinv(plane[on_rim])
    ground = plane @ (to_plane @ values[on_rim])
    noise = max(float((values - ground)[on_rim].std()), 1 / np.sqrt(12))
    dark = ground - values
    total = dark.sum()
    if total < _LEAST_CONTRAST * 0.3 * len(dark) or dark.max() < 5 * noise:
        return centre, np.inf
    shift = dark @ places / total
    leverage = -(places - shift)  # d(shift) / d(values) times the total
    leverage[on_rim] += ((places - shift).T @ plane @ to_plane).T
    variance = (leverage**2).sum(axis=0).mean() * (noise / total) ** 2
    return centre + shift, float(np.sqrt(variance))

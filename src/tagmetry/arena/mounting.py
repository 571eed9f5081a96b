"""How a marker is mounted on a robot, measured by letting the robot move.

Turned on the spot, the marker's centre runs on a circle about the robot's centre c,

    m_i = c + R(f_i) o,     f_i the direction of the marker's top, o the marker in its own axes

which is linear in c and o. The height drops out: it shifts c alone. Driven straight ahead, the
robot goes where its front points, which tells the marker's turn. And the height is what makes the
known square fit the image, or what makes known places fit.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.square_fit import fit_squares
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array, mean_angle_rad, wrap_angle_rad

_LEAST_TURN_RAD = np.pi / 2
_LEAST_WAY_M = 0.1
_STEPS = 4


@dataclass(frozen=True, eq=False)
class SpinCenter:
    """Where a marker is on a robot that turned on the spot.

    Attributes:
        offset_m: The marker's centre from the robot's, in the marker's own axes (toward its top,
            to its left), shape (2,).
        covariance: Of the offset, shape (2, 2), m^2.
        center_m: The robot's centre in the world, shape (2,).
        rms_m: How far the marker's centres are from the circle; large where the robot slipped.
    """

    offset_m: Array
    covariance: Array
    center_m: Array
    rms_m: float

    def forward_left_m(self, turn_rad: float) -> Array:
        """Return the offset in the robot's axes, for a marker with this turn, shape (2,)."""
        return np.asarray(_turn(np.array([turn_rad]))[0] @ self.offset_m)


@dataclass(frozen=True)
class Estimate:
    """A number with its standard deviation.

    Attributes:
        value: In m or rad.
        sd: In the same unit.
    """

    value: float
    sd: float


def offset_from_spin(places: Array) -> SpinCenter:
    """Return where a marker is from the centre of a robot that turned on the spot.

    Args:
        places: The marker's (x, y, direction of its top) in the images, shape (n, 3), m and rad.

    Raises:
        InputError: Fewer than three images, or less than a quarter turn.
    """
    places = np.asarray(places, dtype=np.float64).reshape(-1, 3)
    if len(places) < 3 or _swept_rad(places[:, 2]) < _LEAST_TURN_RAD:
        raise InputError(
            f"a spin needs three images or more over a quarter turn, got {len(places)} over "
            f"{np.degrees(_swept_rad(places[:, 2])):.0f} degrees; let the robot turn a full turn"
        )
    A = np.concatenate([np.broadcast_to(np.eye(2), (len(places), 2, 2)), _turn(places[:, 2])], -1)
    A, b = A.reshape(-1, 4), places[:, :2].ravel()
    found = np.linalg.lstsq(A, b)[0]
    off = b - A @ found
    variance = float(off @ off) / max(1, len(b) - 4)
    covariance = variance * np.linalg.inv(A.T @ A)
    rms_m = float(np.sqrt(2 * np.mean(off**2)))
    return SpinCenter(found[2:], covariance[2:, 2:], found[:2], rms_m)


def turn_from_drive(places: Array, spin: SpinCenter) -> Estimate:
    """Return by how much a marker's top is turned left of the front of a robot that drove ahead.

    Args:
        places: The marker's (x, y, direction of its top) on the straight way, shape (n, 3).
        spin: Where the marker is on the robot.

    Raises:
        InputError: The way is shorter than 0.1 m.
    """
    places = np.asarray(places, dtype=np.float64).reshape(-1, 3)
    centers = places[:, :2] - np.einsum("nij,j->ni", _turn(places[:, 2]), spin.offset_m)
    way_m = np.hypot(*(centers[-1] - centers[0])) if len(places) else 0.0
    if len(places) < 2 or way_m < _LEAST_WAY_M:
        raise InputError(f"a straight drive needs {_LEAST_WAY_M} m or more, got {way_m:.3f} m")
    off = centers - centers.mean(axis=0)
    axis = np.linalg.svd(off, full_matrices=False)[2][0]
    along = off @ axis
    axis = axis if along[-1] > along[0] else -axis
    to_side = off @ [-axis[1], axis[0]]
    turns = wrap_angle_rad(places[:, 2] - np.arctan2(axis[1], axis[0]))
    freedom = max(1, len(places) - 2)
    of_way = float(to_side @ to_side) / freedom / float(along @ along)
    of_turn = float(np.var(turns)) / len(turns)
    return Estimate(mean_angle_rad(turns), float(np.sqrt(of_way + of_turn)))


def height_by_size(
    view: OverheadView,
    detections: Sequence[Detection],
    size_m: float,
    size_sd_m: float,
    near_m: float = 0.0,
) -> Estimate:
    """Return a marker's height that makes its size fit the images, best at several places.

    An error of the size by one part in a thousand is an error of the height by one thousandth of
    the camera's distance: measure the black square with a caliper.

    Args:
        view: The camera over the floor.
        detections: The marker, once in each image.
        size_m: Side of its black square.
        size_sd_m: Standard deviation of that.
        near_m: A first guess.
    """
    if not detections:
        raise InputError("a height needs at least one image of the marker, got none")
    corners = np.array([one.corners_px for one in detections])
    covariances = np.array([one.corners_cov_px2 for one in detections])
    sizes = np.full(len(detections), size_m)
    height_m, sd_m = near_m, np.inf
    for _ in range(_STEPS):
        fits = fit_squares(view, corners, covariances, sizes, np.full(len(detections), height_m))
        weights = fits.higher_sd_m**-2
        height_m += float(weights @ fits.higher_m / weights.sum())
        sd_m = float(weights.sum() ** -0.5)
    distance_m = float(view.T_world_camera.translation[2]) - height_m
    of_size = distance_m * size_sd_m / size_m
    of_camera = float(np.sqrt(view.covariance[2, 2]))
    return Estimate(height_m, float(np.sqrt(sd_m**2 + of_size**2 + of_camera**2)))


def height_at_places(
    view: OverheadView, centers_px: Array, places_m: Array, place_sd_m: float = 1e-3
) -> Estimate:
    """Return the height of a marker that stood at known places.

    A marker that is higher than it is taken to be appears farther from the camera's foot. So places
    far from there tell the height, and the one below the camera tells nothing.

    Args:
        view: The camera over the floor.
        centers_px: Where the images show the marker's centre, shape (n, 2).
        places_m: Where it was, (x, y) in the world, shape (n, 2).
        place_sd_m: Standard deviation of those along each axis.

    Raises:
        InputError: All places are below the camera.
    """
    low = view.points_on_plane(centers_px, 0.0)[:, :2]
    slope = view.points_on_plane(centers_px, -1.0)[:, :2] - low  # rays are straight
    told = float((slope**2).sum())
    if not told > 1e-6:
        raise InputError(
            "places below the camera do not tell a height; put the robot toward the image's corners"
        )
    height_m = float((slope * (low - places_m)).sum()) / told
    return Estimate(height_m, place_sd_m / float(np.sqrt(told)))


def _turn(angles_rad: Array) -> Array:
    """Return rotations by angles (n,), shape (n, 2, 2)."""
    c, s = np.cos(angles_rad), np.sin(angles_rad)
    return np.moveaxis(np.array([[c, -s], [s, c]]), -1, 0)


def _swept_rad(directions: Array) -> float:
    """Return the part of the circle that directions cover: all but their largest gap."""
    if len(directions) < 2:
        return 0.0
    ordered = np.sort(np.mod(directions, 2 * np.pi))
    gaps = np.diff([*ordered, ordered[0] + 2 * np.pi])
    return float(2 * np.pi - gaps.max())

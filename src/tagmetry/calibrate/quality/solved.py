"""A calibration as its solver had it: what was solved, from what, and what was free.

Frames: `board` as its maker says, `camera` x right, y down, z forward.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.calibrate.belief import shape_belief_m
from tagmetry.calibrate.bundle import Bundle, Freedom, linearise
from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.sightings import Sightings, gather
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_NO_FREEDOM = 1e-13  # of the largest eigenvalue of a correlation matrix: rounding


@dataclass(frozen=True, eq=False)
class Solved:
    """What was solved.

    Attributes:
        bundle: The camera, the board's poses and points.
        seen: The corners; those that were left out have no weight.
        freedom: What was free: each column of its basis is one step of about a standard deviation.
        variance: Mean squared error of a corner along an axis in its own deviations.
    """

    bundle: Bundle
    seen: Sightings
    freedom: Freedom
    variance: float

    @classmethod
    def of(cls, calibration: Calibration) -> "Solved":
        """Return what a calibration was solved from."""
        seen = _weighed(calibration)
        camera = calibration.camera
        Ts = calibration.Ts_camera_board
        bundle = Bundle(
            camera.lens.kind,
            np.concatenate([camera.focal_px, camera.center_px, camera.lens.coefficients]),
            Ts.rotation.as_matrix(),
            np.asarray(Ts.translation),
            calibration.p_board[seen.points],
        )
        freedom = freedom_of(calibration.formula_covariance)
        variance = _variance(bundle, seen, freedom)
        if (
            calibration.shape_released
        ):  # the belief in the board weighs against the errors' own size
            seen, variance = seen.weighted(np.array(1 / variance)), 1.0
            freedom = replace(freedom, shape_sd_m=shape_belief_m(seen.p_board))
        return cls(bundle, seen, freedom, variance)

    def view_informations(self) -> Array:
        """Return what each view tells of the free intrinsics, shape (n, free, free).

        The errors' own size is in it: the sum's inverse is the formula's covariance.
        """
        informations = view_informations(self.bundle, self.seen, self.freedom)
        return np.asarray(informations / self.variance)


def freedom_of(covariance: Array) -> Freedom:
    """Return what was free to give a covariance: the directions in which it is not zero.

    Args:
        covariance: Of the intrinsics, shape (m, m).
    """
    sd = np.sqrt(np.diag(covariance))
    scale = np.where(sd > 0, sd, 1.0)
    values, vectors = np.linalg.eigh(covariance / np.outer(scale, scale))
    return Freedom(scale[:, None] * vectors[:, values > _NO_FREEDOM * values[-1]])


def view_informations(bundle: Bundle, seen: Sightings, freedom: Freedom) -> Array:
    """Return J^T W J of each view with its own pose eliminated, shape (n, free, free)."""
    return view_equations(bundle, seen, freedom)[0]


def view_equations(bundle: Bundle, seen: Sightings, freedom: Freedom) -> tuple[Array, Array]:
    """Return what each view says of the free intrinsics by itself, its own pose eliminated.

    Returns:
        J^T W J, shape (n, free, free), and J^T W e, shape (n, free).

    Reference: B. Triggs et al., Bundle Adjustment, 2000, section 6.1, for one view.
    """
    linear = linearise(bundle, seen, freedom)
    n = len(seen)
    by_intrinsics = linear.by_intrinsics.reshape(n, -1, freedom.count)
    error = linear.error.reshape(n, -1, 1)
    by_pose = linear.by_pose.reshape(n, -1, 6)
    size = np.maximum(np.linalg.norm(by_pose, axis=1, keepdims=True), 1e-300)
    axes, _ = np.linalg.qr(by_pose / size)
    left = by_intrinsics - axes @ (np.swapaxes(axes, 1, 2) @ by_intrinsics)
    turned = np.swapaxes(left, 1, 2)
    return turned @ left, (turned @ error)[..., 0]


def honest_covariance(calibration: Calibration) -> Array:
    """Return the camera's covariance, shape (4 + c, 4 + c).

    Raises:
        InputError: The calibration has none.
    """
    covariance = calibration.camera.covariance
    if covariance is None:
        raise InputError(
            "expected a calibration whose camera has a covariance, got none; "
            "calibrate again, with nothing but views"
        )
    return covariance


def _weighed(calibration: Calibration) -> Sightings:
    """Return the corners with those that were left out at no weight."""
    seen = gather(calibration.views)
    factors = np.zeros(seen.used.shape)
    for row, (view, kept) in enumerate(zip(calibration.views, calibration.kept, strict=True)):
        factors[row, np.searchsorted(seen.points, view.points)] = kept
    return seen.weighted(factors)


def _variance(bundle: Bundle, seen: Sightings, freedom: Freedom) -> float:
    error = linearise(bundle, seen, freedom).error
    spare = 2 * seen.corner_count - freedom.count - 6 * len(seen)
    return float((error**2).sum() / max(spare, 1))

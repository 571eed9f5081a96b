"""Where a robot is by its wheels alone, and what its wheels are by what a camera saw of it.

Between two readings each wheel turned by an angle; the robot drove the arc of length
(r_l a_l + r_r a_r) / 2 that turned it by (r_r a_r - r_l a_l) / b. The calibration finds r_l, r_r
and b so that these arcs, chained from one camera pose to the next, end where the camera saw it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from tagmetry.arena.drive import Drive
from tagmetry.arena.place import Place, turned_rad
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_SLIP_SIGMAS = 4.0


@dataclass(frozen=True, eq=False)
class Stretch:
    """What happened between two images that showed the robot.

    Attributes:
        start: Where the camera saw it first.
        end: Where the camera saw it last.
        wheel_turns_rad: By how much the left and the right wheel turned, reading by reading,
            shape (n, 2).
    """

    start: Place
    end: Place
    wheel_turns_rad: Array


@dataclass(frozen=True, eq=False)
class WheelFit:
    """The wheels that explain what was seen.

    Attributes:
        left_radius_m: Of the left wheel.
        right_radius_m: Of the right wheel.
        track_m: Between the points of contact.
        covariance: Of these three, shape (3, 3), m^2.
        slipped: Of each stretch, shape (n,), whether the wheels cannot explain it: they slipped.
    """

    left_radius_m: float
    right_radius_m: float
    track_m: float
    covariance: Array
    slipped: NDArray[np.bool_]


def dead_reckoned(start: Place, wheel_turns_rad: Array, drive: Drive) -> tuple[Place, ...]:
    """Return where the robot is after every reading of its wheels, by exact arcs."""
    radii_m = np.full(2, drive.wheel_radius_m)
    course = _course(wheel_turns_rad, radii_m, drive.track_m)
    return tuple(start @ Place(x_m, y_m, turned_rad(turn)) for x_m, y_m, turn in course.tolist())


def fit_wheels(
    stretches: Sequence[Stretch], guess: Drive, place_sd_m: float, heading_sd_rad: float
) -> WheelFit:
    """Return the wheels' radii and the track from driven stretches; slipped ones count little.

    Args:
        stretches: At least 3, some of which turn and some of which go ahead.
        guess: What the data sheet says.
        place_sd_m: Of the camera's x and y of the robot, standard deviation.
        heading_sd_rad: Of its heading.
    """
    if len(stretches) < 3:
        raise InputError(
            f"the wheels' calibration needs at least 3 driven stretches, got {len(stretches)}"
        )
    whiten = [_whitening(one, place_sd_m, heading_sd_rad) for one in stretches]

    def misses(wheels: Array) -> Array:
        pairs = zip(whiten, stretches, strict=True)
        return np.concatenate([W @ _miss(one, wheels) for W, one in pairs])

    start = np.array([guess.wheel_radius_m, guess.wheel_radius_m, guess.track_m])
    found = least_squares(misses, start, x_scale=start, loss="soft_l1", f_scale=2.0)
    slipped = np.linalg.norm(misses(found.x).reshape(-1, 3), axis=1) > _SLIP_SIGMAS
    left_m, right_m, track_m = found.x.tolist()
    covariance = _covariance(np.asarray(found.jac), slipped)
    return WheelFit(left_m, right_m, track_m, covariance, slipped)


def _covariance(jacobian: Array, slipped: NDArray[np.bool_]) -> Array:
    """Return it from the stretches that did not slip.

    Where an end is the next stretch's start, neighbours share an error of opposite sign: what is
    stated is then too large, never too small.
    """
    kept = jacobian[np.repeat(~slipped, 3)]
    information = kept.T @ kept
    if np.linalg.cond(information) > 1e12:
        raise InputError(
            "the wheels' calibration needs stretches that go ahead and others that turn; "
            "these leave a radius or the track open"
        )
    return np.asarray(np.linalg.inv(information))


def _whitening(stretch: Stretch, place_sd_m: float, heading_sd_rad: float) -> Array:
    """Return what makes a miss's errors independent and of deviation 1, shape (3, 3).

    Both ends are measured; the start's heading error swings the whole stretch about it.
    """
    seen = stretch.end.seen_from(stretch.start)
    swing = np.array([seen.y_m, -seen.x_m, -1.0])
    covariance = np.diag([2 * place_sd_m**2, 2 * place_sd_m**2, heading_sd_rad**2])
    covariance += heading_sd_rad**2 * np.outer(swing, swing)
    return np.asarray(np.linalg.inv(np.linalg.cholesky(covariance)))


def _miss(stretch: Stretch, wheels: Array) -> Array:
    """Return by how much the wheels' end lies off the camera's, in the start's frame."""
    reached = _course(stretch.wheel_turns_rad, wheels[:2], wheels[2])[-1]
    seen = stretch.end.seen_from(stretch.start)
    return np.array(
        [reached[0] - seen.x_m, reached[1] - seen.y_m, turned_rad(reached[2] - seen.heading_rad)]
    )


def _course(wheel_turns_rad: Array, radii_m: Array, track_m: float) -> Array:
    """Return x, y and heading after every reading, from the start's frame, shape (n, 3)."""
    left_m, right_m = (np.asarray(wheel_turns_rad) * radii_m).T
    turns_rad = (right_m - left_m) / track_m
    headings_rad = np.cumsum(turns_rad)
    along_rad = headings_rad - turns_rad / 2
    chords_m = (left_m + right_m) / 2 * np.sinc(turns_rad / (2 * np.pi))
    x_m, y_m = np.cumsum(chords_m * np.cos(along_rad)), np.cumsum(chords_m * np.sin(along_rad))
    return np.column_stack([x_m, y_m, headings_rad])

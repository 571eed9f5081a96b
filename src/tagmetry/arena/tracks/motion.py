"""How robots move between images: straight ahead or on a circle, but for what is not known.

    v' = a,   w' = b,   (x, y)' = v (cos f, sin f) + s (-sin f, cos f),   f' = w

with a, b and s white: accelerations of the wheels, and a slip to the side. Over a step of dt the
mean goes along the chord of its circle, v dt sinc(w dt / 2) in the direction f + w dt / 2. Many
tracks are moved at once. Long steps are taken in parts, so that the circle's bend is heeded.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, wrap_angle_rad

_LONGEST_S = 0.1
_MOST_PARTS = 50


@dataclass(frozen=True)
class Motion:
    """White accelerations and slip of a known strength.

    Attributes:
        acceleration_mps2: Typical change of the speed within one second, m/s per root second.
        turning_radps2: The same of the turn rate, rad/s per root second.
        slip_m: Typical way to the side within one second, m per root second.
    """

    acceleration_mps2: float = 0.5
    turning_radps2: float = 4.0
    slip_m: float = 0.005

    def __post_init__(self) -> None:
        for name in ("acceleration_mps2", "turning_radps2", "slip_m"):
            if not 0 < getattr(self, name) < np.inf:
                raise InputError(f"{name} must be positive and finite, got {getattr(self, name)}")

    def moved(self, means: Array, covariances: Array, step_s: float) -> tuple[Array, Array]:
        """Return n tracks some seconds later.

        Args:
            means: (x, y, heading, speed, turn rate), shape (n, 5).
            covariances: Shape (n, 5, 5).
            step_s: Not negative.
        """
        parts = int(np.clip(np.ceil(step_s / _LONGEST_S), 1, _MOST_PARTS))
        for _ in range(parts):
            means, covariances = self._moved(means, covariances, step_s / parts)
        return means, covariances

    def _moved(self, means: Array, covariances: Array, dt: float) -> tuple[Array, Array]:
        _, _, heading, speed, rate = means.T
        toward, share = heading + rate * dt / 2, np.sinc(rate * dt / (2 * np.pi))
        way = dt * share * np.stack([np.cos(toward), np.sin(toward)])
        after = means.copy()
        after[:, :2] += (speed * way).T
        after[:, 2] = wrap_angle_rad(heading + rate * dt)
        F = _by_state(way, speed, dt)
        G = _along(toward)
        unknown = G @ self._unknown(dt, speed) @ np.swapaxes(G, 1, 2)
        return after, F @ covariances @ np.swapaxes(F, 1, 2) + unknown

    def _unknown(self, dt: float, speed: Array) -> Array:
        """Return what is added over a step, in (along, to the left, f, v, w), shape (n, 5, 5)."""
        a2, b2 = self.acceleration_mps2**2, self.turning_radps2**2
        added = np.zeros((len(speed), 5, 5))
        added[:, 0, 0], added[:, 3, 3] = a2 * dt**3 / 3, a2 * dt
        added[:, 0, 3] = added[:, 3, 0] = a2 * dt**2 / 2
        added[:, 2, 2], added[:, 4, 4] = b2 * dt**3 / 3, b2 * dt
        added[:, 2, 4] = added[:, 4, 2] = b2 * dt**2 / 2
        added[:, 1, 1] = self.slip_m**2 * dt + b2 * speed**2 * dt**5 / 20
        added[:, 1, 2] = added[:, 2, 1] = b2 * speed * dt**4 / 8
        added[:, 1, 4] = added[:, 4, 1] = b2 * speed * dt**3 / 6
        return added


def _by_state(way: Array, speed: Array, dt: float) -> Array:
    """Return d(after) / d(before), shape (n, 5, 5)."""
    F = np.broadcast_to(np.eye(5), (len(speed), 5, 5)).copy()
    F[:, 0, 2], F[:, 1, 2] = -speed * way[1], speed * way[0]
    F[:, :2, 3] = way.T
    F[:, :2, 4] = F[:, :2, 2] * dt / 2
    F[:, 2, 4] = dt
    return F


def _along(toward: Array) -> Array:
    """Return the turn from (along, to the left, …) to (x, y, …), shape (n, 5, 5)."""
    G = np.broadcast_to(np.eye(5), (len(toward), 5, 5)).copy()
    G[:, 0, 0] = G[:, 1, 1] = np.cos(toward)
    G[:, 1, 0] = np.sin(toward)
    G[:, 0, 1] = -G[:, 1, 0]
    return G

"""One of the stories that the filter keeps: a pose that moves, with its covariance and weight."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array, RigidTransform, perturb_pose

_FIRST_SPEED_M_S = 2.0  # deviations of what is not known at the first image
_FIRST_RATE_RAD_S = 2.0


@dataclass(frozen=True, eq=False)
class Branch:
    """A camera that moves.

    Attributes:
        T_world_camera: Where it is.
        speed_m_s: Its velocity in the world frame, shape (3,).
        rate_rad_s: Its angular velocity in the world frame, shape (3,).
        covariance: Of (translation, rotation vector, velocity, angular velocity), shape (12, 12);
            the pose's change on the left in the world frame; m, rad, m/s, rad/s.
        log_weight: Logarithm of its probability, up to a constant.
    """

    T_world_camera: RigidTransform
    speed_m_s: Array
    rate_rad_s: Array
    covariance: Array
    log_weight: float

    @classmethod
    def at_rest(
        cls, T_world_camera: RigidTransform, covariance: Array, probability: float
    ) -> "Branch":
        """Return a camera of which only the pose is known."""
        whole = np.zeros((12, 12))
        whole[:6, :6] = covariance
        whole[6:9, 6:9] = _FIRST_SPEED_M_S**2 * np.eye(3)
        whole[9:, 9:] = _FIRST_RATE_RAD_S**2 * np.eye(3)
        log_weight = float(np.log(max(probability, 1e-300)))
        return cls(T_world_camera, np.zeros(3), np.zeros(3), whole, log_weight)

    def corrected(self, by_state: Array, noise: Array, innovation: Array) -> "Branch":
        """Return the branch after a measurement (Kalman's equations, Joseph's form).

        Args:
            by_state: d(measured) / d(state), shape (n, 12).
            noise: Covariance of the measurement, shape (n, n).
            innovation: Measured minus expected, shape (n,).
        """
        spread = by_state @ self.covariance @ by_state.T + noise
        gain = np.linalg.solve(spread, by_state @ self.covariance).T
        change = gain @ innovation
        rest = np.eye(12) - gain @ by_state
        covariance = rest @ self.covariance @ rest.T + gain @ noise @ gain.T
        return Branch(
            perturb_pose(self.T_world_camera, change[:6]),
            self.speed_m_s + change[6:9],
            self.rate_rad_s + change[9:],
            (covariance + covariance.T) / 2,
            self.log_weight + log_density(innovation, spread),
        )


def log_density(innovation: Array, spread: Array) -> float:
    """Return the logarithm of a normal density with a covariance, without the power of 2 pi."""
    _, log_determinant = np.linalg.slogdet(spread)
    return -0.5 * (float(innovation @ np.linalg.solve(spread, innovation)) + float(log_determinant))

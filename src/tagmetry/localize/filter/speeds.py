"""Speeds from elsewhere: odometry and gyroscopes, as measurements of the filter's state."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, cross_matrix
from tagmetry.localize.filter.branch import Branch


@dataclass(frozen=True, eq=False)
class Speeds:
    """What odometry or a gyroscope says of the camera's motion, in the camera's own frame.

    Attributes:
        speed_m_s: Velocity, shape (3,); None where it is not measured.
        speed_deviation_m_s: Its standard deviation along each axis.
        rate_rad_s: Angular velocity, shape (3,); None where it is not measured.
        rate_deviation_rad_s: Its standard deviation about each axis.
    """

    speed_m_s: Array | None = None
    speed_deviation_m_s: float = 0.02
    rate_rad_s: Array | None = None
    rate_deviation_rad_s: float = 0.01

    def __post_init__(self) -> None:
        for name in ("speed_m_s", "rate_rad_s"):
            value = getattr(self, name)
            if value is not None and (np.shape(value) != (3,) or not np.isfinite(value).all()):
                raise InputError(f"{name} must be three finite numbers, got {value}")
        for name in ("speed_deviation_m_s", "rate_deviation_rad_s"):
            if not 0 < getattr(self, name) < np.inf:
                raise InputError(f"{name} must be positive and finite, got {getattr(self, name)}")

    def corrected(self, branch: Branch) -> Branch:
        """Return a branch that heeds what was measured."""
        if self.speed_m_s is not None:
            deviation = self.speed_deviation_m_s
            branch = _corrected(branch, self.speed_m_s, branch.speed_m_s, 6, deviation)
        if self.rate_rad_s is not None:
            deviation = self.rate_deviation_rad_s
            branch = _corrected(branch, self.rate_rad_s, branch.rate_rad_s, 9, deviation)
        return branch


def _corrected(
    branch: Branch, measured: Array, expected: Array, column: int, deviation: float
) -> Branch:
    """Correct by a vector of the camera's frame: R v_camera - v_world is 0 but for its noise.

    With R <- Exp(dr) R it changes by -[R v]x dr, so v_world is measured with [R v]x dr beside it.
    """
    turned = branch.T_world_camera.rotation.apply(measured)
    by_state = np.zeros((3, 12))
    by_state[:, column : column + 3] = np.eye(3)
    by_state[:, 3:6] = cross_matrix(turned)
    return branch.corrected(by_state, deviation**2 * np.eye(3), turned - expected)

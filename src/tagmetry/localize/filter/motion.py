"""How a camera moves between images: on as before, but for accelerations that are not known."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array, cross_matrix, perturb_pose
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize.filter.branch import Branch


@dataclass(frozen=True)
class Motion:
    """White accelerations of a known strength.

    Attributes:
        acceleration_m_s2: Typical change of the velocity within one second, m/s per root second.
        turning_rad_s2: The same of the angular velocity, rad/s.
    """

    acceleration_m_s2: float = 1.0
    turning_rad_s2: float = 2.0

    def __post_init__(self) -> None:
        for name in ("acceleration_m_s2", "turning_rad_s2"):
            if not 0 < getattr(self, name) < np.inf:
                raise InputError(f"{name} must be positive and finite, got {getattr(self, name)}")

    def moved(self, branch: Branch, step_s: float) -> Branch:
        """Return a branch some seconds later."""
        change = np.concatenate([branch.speed_m_s, branch.rate_rad_s]) * step_s
        by_state = np.eye(12)
        by_state[:3, 6:9] = step_s * np.eye(3)
        by_state[3:6, 3:6] = Rotation.from_rotvec(change[3:]).as_matrix()
        by_state[3:6, 9:] = step_s * (np.eye(3) + cross_matrix(change[3:]) / 2)
        covariance = by_state @ branch.covariance @ by_state.T + self._unknown(step_s)
        T = perturb_pose(branch.T_world_camera, change)
        return Branch(T, branch.speed_m_s, branch.rate_rad_s, covariance, branch.log_weight)

    def _unknown(self, step_s: float) -> Array:
        """Return what white accelerations add to the covariance, shape (12, 12)."""
        strengths = np.repeat([self.acceleration_m_s2**2, self.turning_rad_s2**2], 3)
        shares = np.array([[step_s**3 / 3, step_s**2 / 2], [step_s**2 / 2, step_s]])
        return np.asarray(np.kron(shares, np.diag(strengths)))

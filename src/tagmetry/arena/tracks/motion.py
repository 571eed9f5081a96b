"""How robots move between images: straight ahead or on a circle, but for what is not known.

    v' = a,   w' = b,   (x, y)' = v (cos f, sin f) + s (-sin f, cos f),   f' = w

with a, b and s white: accelerations of the wheels, and a slip to the side. Over a step of dt the
mean goes along the chord of its circle, v dt sinc(w dt / 2) in the direction f + w dt / 2. Many
tracks are moved at once. Long steps are taken in parts, so that the circle's bend is heeded.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.arena.tracks.filter import predict
from tagmetry.errors import InputError
from tagmetry.geometry import Array

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
        strengths = (
            float(self.acceleration_mps2),
            float(self.turning_radps2),
            float(self.slip_m),
        )
        means, covariances = means.copy(), covariances.copy()
        for _ in range(parts):
            predict(means, covariances, float(step_s / parts), strengths)
        return means, covariances

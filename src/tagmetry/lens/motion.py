"""Where a marker will be: a straight line through its last places, at constant speed."""

from dataclasses import dataclass

import numpy as np

from tagmetry.geometry import Array

_KEPT = 4
_OLDEST_S = 0.5


@dataclass(frozen=True, eq=False)
class Motion:
    """The last places of a marker.

    Attributes:
        times_s: When, rising, shape (n,).
        places_m: Where in the camera frame, shape (n, 3).
    """

    times_s: Array
    places_m: Array

    @classmethod
    def at_rest(cls, time_s: float, p_camera: Array) -> "Motion":
        """Return the motion of a marker that was seen once."""
        return cls(np.array([time_s]), np.asarray(p_camera, dtype=np.float64)[None])

    def seen(self, time_s: float, p_camera: Array) -> "Motion":
        """Return the motion with one more place; places that are too old are forgotten."""
        if not time_s > self.times_s[-1]:
            return self
        recent = self.times_s > time_s - _OLDEST_S
        times_s = np.append(self.times_s[recent], time_s)[-_KEPT:]
        return Motion(times_s, np.concatenate([self.places_m[recent], p_camera[None]])[-_KEPT:])

    @property
    def speed_m_s(self) -> Array:
        """Velocity by least squares, shape (3,)."""
        if len(self.times_s) < 2:
            return np.zeros(3)
        passed_s = self.times_s - self.times_s.mean()
        return np.asarray(passed_s @ self.places_m / (passed_s @ passed_s))

    def at(self, time_s: float) -> Array:
        """Return the place at a time, shape (3,)."""
        middle = self.places_m.mean(axis=0)
        return np.asarray(middle + self.speed_m_s * (time_s - float(self.times_s.mean())))

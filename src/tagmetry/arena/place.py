"""A place on the floor with a heading, and how one is seen from another."""

from dataclasses import dataclass
from math import atan2, cos, hypot, pi, sin
from typing import Self

import numpy as np

from tagmetry.geometry import Array


@dataclass(frozen=True)
class Place:
    """Where something stands and which way it looks.

    Attributes:
        x_m: In the frame it is given in.
        y_m: In the same frame.
        heading_rad: From that frame's x axis, counter-clockwise, in (-pi, pi].
    """

    x_m: float
    y_m: float
    heading_rad: float

    def __matmul__(self, other: "Place") -> "Place":
        """Return a place given in this one's frame in the frame that this one is given in."""
        c, s = cos(self.heading_rad), sin(self.heading_rad)
        return Place(
            self.x_m + c * other.x_m - s * other.y_m,
            self.y_m + s * other.x_m + c * other.y_m,
            turned_rad(self.heading_rad + other.heading_rad),
        )

    def inverse(self) -> "Place":
        """Return the frame's origin as seen from this place."""
        c, s = cos(self.heading_rad), sin(self.heading_rad)
        return Place(
            -c * self.x_m - s * self.y_m,
            s * self.x_m - c * self.y_m,
            turned_rad(-self.heading_rad),
        )

    def seen_from(self, other: "Place") -> "Place":
        """Return this place in the frame of another: x ahead of it, y to its left."""
        return other.inverse() @ self

    def distance_m(self, other: "Place") -> float:
        """Return how far it is to the other, centre to centre."""
        return hypot(other.x_m - self.x_m, other.y_m - self.y_m)

    @property
    def xy_m(self) -> Array:
        """Its two coordinates, shape (2,)."""
        return np.array([self.x_m, self.y_m])

    @property
    def bearing_rad(self) -> float:
        """Its direction as seen from the frame's origin."""
        return atan2(self.y_m, self.x_m)

    def moved(self, ahead_m: float, turned_by_rad: float) -> Self:
        """Return where it is after an arc of this length that turns it by this angle."""
        half_rad = turned_by_rad / 2
        chord_m = ahead_m * _sinc(half_rad)
        along_rad = self.heading_rad + half_rad
        return type(self)(
            self.x_m + chord_m * cos(along_rad),
            self.y_m + chord_m * sin(along_rad),
            turned_rad(self.heading_rad + turned_by_rad),
        )


def turned_rad(angle_rad: float) -> float:
    """Return the same direction in (-pi, pi]."""
    turned = pi - (pi - angle_rad) % (2 * pi)
    return pi if turned == -pi else turned


def _sinc(angle_rad: float) -> float:
    return sin(angle_rad) / angle_rad if abs(angle_rad) > 1e-6 else 1 - angle_rad**2 / 6

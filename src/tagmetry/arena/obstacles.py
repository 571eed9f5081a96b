"""Virtual obstacles: discs and walls that robots are told of, and that hide what is behind them."""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray


@dataclass(frozen=True)
class Disc:
    """A round obstacle.

    Attributes:
        center_m: (x, y) in the world.
        radius_m: Its radius.
        name: What people call it.
    """

    center_m: tuple[float, float]
    radius_m: float
    name: str = "disc"

    def __post_init__(self) -> None:
        if not (np.isfinite(self.center_m).all() and 0 < self.radius_m < np.inf):
            raise InputError(
                f"obstacle {self.name}: expected a finite centre and a positive radius, got "
                f"{self.center_m} and {self.radius_m}"
            )

    def nearest_point(self, p: Array) -> Array:
        """Return the point of it that is nearest to a place, shape (2,)."""
        toward = p - self.center_m
        away_m = float(np.hypot(*toward))
        if away_m <= self.radius_m:
            return np.asarray(p, dtype=np.float64)
        return np.asarray(self.center_m + toward * (self.radius_m / away_m))

    def hides(self, start: Array, ends: Array) -> BoolArray:
        """Say of straight lines from a place whether it is between, shape (n,)."""
        center, radius_m = np.array([self.center_m]), np.array([self.radius_m])
        return between(start, ends, center, radius_m)[:, 0]


@dataclass(frozen=True)
class Wall:
    """A straight wall without thickness.

    Attributes:
        start_m: (x, y) in the world.
        end_m: (x, y) in the world.
        name: What people call it.
    """

    start_m: tuple[float, float]
    end_m: tuple[float, float]
    name: str = "wall"

    def __post_init__(self) -> None:
        if not np.isfinite([self.start_m, self.end_m]).all() or self.start_m == self.end_m:
            raise InputError(
                f"obstacle {self.name}: expected two different finite ends, got {self.start_m} "
                f"and {self.end_m}"
            )

    def nearest_point(self, p: Array) -> Array:
        """Return the point of it that is nearest to a place, shape (2,)."""
        start, along = np.array(self.start_m), np.subtract(self.end_m, self.start_m)
        share = np.clip((p - start) @ along / (along @ along), 0.0, 1.0)
        return np.asarray(start + share * along)

    def hides(self, start: Array, ends: Array) -> BoolArray:
        """Say of straight lines from a place whether it is between, shape (n,)."""
        low, along = np.array(self.start_m), np.subtract(self.end_m, self.start_m)
        ways = ends - start
        turn = _cross(ways, along)
        with np.errstate(divide="ignore", invalid="ignore"):
            on_way = _cross(low - start, along) / turn
            on_wall = _cross(low - start, ways) / turn
            crosses = (on_way > 0) & (on_way < 1) & (on_wall >= 0) & (on_wall <= 1)
        return np.asarray(crosses)


Obstacle = Disc | Wall


def between(start: Array, ends: Array, centers: Array, radii_m: Array) -> BoolArray:
    """Say of straight lines from a place which discs they cross, shape (n, m).

    Args:
        start: Shape (2,).
        ends: Shape (n, 2).
        centers: Of the discs, shape (m, 2).
        radii_m: Of the discs, shape (m,).
    """
    ways = ends - start
    lengths2 = np.maximum((ways**2).sum(axis=1), 1e-300)
    shares = np.clip(ways @ (centers - start).T / lengths2[:, None], 0.0, 1.0)
    nearest = start + shares[..., None] * ways[:, None, :]
    return np.asarray(((nearest - centers) ** 2).sum(axis=-1) < radii_m**2)


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])

"""Where squares lie on level planes: maximum likelihood of (x, y, direction) from four corners.

The corners of a square of side s at (x, y), whose top points to the direction f, are

    p_i = (x, y) + s R(f) q_i,   z = h,   q_i = (+-1/2, +-1/2) forward and left

and three numbers are asked of eight: chi2 with five degrees of freedom tells whether size, height
and level are as they are said to be. All squares of an image are solved at once, by one step of
Gauss and Newton: from where rays of the table meet the plane, a second would move by less than a
micrometre.
"""

from dataclasses import dataclass, replace

import numpy as np

from tagmetry.arena.on_plane import OverheadView
from tagmetry.geometry import Array

FREEDOM = 5
_CORNERS = np.array([[0.5, 0.5], [0.5, -0.5], [-0.5, -0.5], [-0.5, 0.5]])  # forward, left


@dataclass(frozen=True, eq=False)
class SquareFits:
    """n squares on level planes.

    Attributes:
        places: (x, y, direction of the top) in the world, m and rad, shape (n, 3).
        noise: Their covariance from the corners' noise, shape (n, 3, 3).
        by_camera: How they move with the camera's pose, shape (n, 3, 6).
        by_height: How they move with the plane's height, shape (n, 3).
        higher_m: By how much the plane would be higher by the square's size, shape (n,).
        higher_sd_m: Standard deviation of that from the corners' noise, shape (n,).
        chi2: Of the corners, with `FREEDOM` degrees, shape (n,).
    """

    places: Array
    noise: Array
    by_camera: Array
    by_height: Array
    higher_m: Array
    higher_sd_m: Array
    chi2: Array


def fit_squares(
    view: OverheadView, corners_px: Array, covariances_px2: Array, sizes_m: Array, heights_m: Array
) -> SquareFits:
    """Return where n squares lie.

    Args:
        view: The camera.
        corners_px: Clockwise from each one's own top left, shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8), positive definite.
        sizes_m: Shape (n,).
        heights_m: Of the planes, shape (n,).

    Returns:
        The fits; NaN where a ray misses its plane.
    """
    weights = np.asarray(np.linalg.inv(covariances_px2), dtype=np.float64)
    places = _started(view.points_near_plane(corners_px, heights_m[:, None]))
    at = _Linearized.at(view, corners_px, weights, places, sizes_m, heights_m)
    places = places + np.einsum("nij,nj->ni", at.gain, at.residuals)
    left_px = corners_px - view.pixels_of(_corners(places, sizes_m, heights_m)[0])
    return replace(at, residuals=left_px.reshape(-1, 8)).fits(places, weights)


@dataclass(frozen=True, eq=False)
class _Linearized:
    """The corners near a solution.

    Attributes:
        residuals: Seen minus predicted, shape (n, 8), px.
        noise: Covariance of the places, shape (n, 3, 3).
        gain: d(place) / d(corners), shape (n, 3, 8).
        by_place: d(corners) / d(place), shape (n, 8, 3).
        by_camera: d(corners) / d(camera's pose), shape (n, 8, 6).
        by_height: d(corners) / d(height), shape (n, 8).
    """

    residuals: Array
    noise: Array
    gain: Array
    by_place: Array
    by_camera: Array
    by_height: Array

    @classmethod
    def at(
        cls,
        view: OverheadView,
        corners_px: Array,
        weights: Array,
        places: Array,
        sizes_m: Array,
        heights_m: Array,
    ) -> "_Linearized":
        p_world, by_turn = _corners(places, sizes_m, heights_m)
        pixels, by_point = view.project(p_world)
        turned = np.einsum("nkij,nkj->nki", by_point[..., :2], by_turn)
        by_place = np.concatenate([by_point[..., :2], turned[..., None]], axis=-1)
        by_place = by_place.reshape(-1, 8, 3)
        weighted = np.swapaxes(by_place, 1, 2) @ weights
        noise = np.linalg.inv(weighted @ by_place)
        return cls(
            (corners_px - pixels).reshape(-1, 8),
            noise,
            noise @ weighted,
            by_place,
            view.by_camera(p_world, by_point).reshape(-1, 8, 6),
            by_point[..., 2].reshape(-1, 8),
        )

    def fits(self, places: Array, weights: Array) -> SquareFits:
        """Return the solution with all that is known of it."""
        by_height = -np.einsum("nij,nj->ni", self.gain, self.by_height)
        free = self.by_height + np.einsum("nij,nj->ni", self.by_place, by_height)
        weighted = np.einsum("nij,nj->ni", weights, free)
        told = np.einsum("ni,ni->n", weighted, free)
        return SquareFits(
            places,
            self.noise,
            -self.gain @ self.by_camera,
            by_height,
            np.einsum("ni,ni->n", weighted, self.residuals) / told,
            1 / np.sqrt(told),
            np.einsum("ni,nij,nj->n", self.residuals, weights, self.residuals),
        )


def _started(p_world: Array) -> Array:
    """Return places from four points each, shape (n, 4, 3) to (n, 3)."""
    top_left, top_right, bottom_right, bottom_left = np.moveaxis(p_world[..., :2], 1, 0)
    up = top_left + top_right - bottom_left - bottom_right
    left = top_left + bottom_left - top_right - bottom_right
    forward = up + np.stack([left[:, 1], -left[:, 0]], axis=-1)
    direction = np.arctan2(forward[:, 1], forward[:, 0])
    return np.column_stack([p_world[..., :2].mean(axis=1), direction])


def _corners(places: Array, sizes_m: Array, heights_m: Array) -> tuple[Array, Array]:
    """Return the corners, shape (n, 4, 3), and d(x, y) / d(direction), shape (n, 4, 2)."""
    cosine, sine = np.cos(places[:, 2])[:, None], np.sin(places[:, 2])[:, None]
    forward, left = (sizes_m[:, None] * axis for axis in _CORNERS.T)
    x, y = cosine * forward - sine * left, sine * forward + cosine * left
    by_turn = np.stack([-y, x], axis=-1)
    z = np.broadcast_to(heights_m[:, None], x.shape)
    return np.stack([places[:, :1] + x, places[:, 1:2] + y, z], axis=-1), by_turn

"""Where squares lie on level planes: maximum likelihood of (x, y, direction) from four corners.

The corners of a square of side s at (x, y), whose top points to the direction f, are

    p_i = (x, y) + s R(f) q_i,   z = h,   q_i = (+-1/2, +-1/2) forward and left

and three numbers are asked of eight: chi2 with five degrees of freedom tells whether size, height
and level are as they are said to be. The rays of the corners meet the plane at p'_i, and near there
pixels change by A_i = d(pixel) / d(x, y), so that what a corner is off by is A_i (p'_i - p_i): no
point needs to be projected. From the square through the p'_i, one step of Gauss and Newton is left
to do; a second would move by less than a micrometre.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.square_kernel import fit_all
from tagmetry.geometry import Array
from tagmetry.localize.joint.rays import rays_and_jacobians

FREEDOM = 5


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

    @classmethod
    def unknown(cls, count: int) -> "SquareFits":
        """Return fits of squares of which nothing is known."""
        return cls(
            np.full((count, 3), np.nan),
            np.full((count, 3, 3), np.nan),
            np.full((count, 3, 6), np.nan),
            np.full((count, 3), np.nan),
            np.full(count, np.nan),
            np.full(count, np.nan),
            np.full(count, np.nan),
        )


def fit_squares(
    view: OverheadView, corners_px: Array, covariances_px2: Array, sizes_m: Array, heights_m: Array
) -> SquareFits:
    """Return where n squares lie.

    Args:
        view: The camera.
        corners_px: Clockwise from each one's own top left, shape (n, 4, 2).
        covariances_px2: Shape (n, 8, 8).
        sizes_m: Shape (n,).
        heights_m: Of the planes, shape (n,).

    Returns:
        The fits; NaN where a ray misses its plane, or a covariance is not positive definite.
    """
    corners, covariances, sizes, heights = (
        np.array(one, dtype=np.float64) for one in (corners_px, covariances_px2, sizes_m, heights_m)
    )
    rays, by_point = rays_and_jacobians(view.camera, corners)
    fits = SquareFits.unknown(len(rays))
    fit_all(
        (rays, by_point, covariances, sizes, heights),
        (view.R_world_camera, view.camera_in_world),
        (fits.places, fits.noise, fits.by_camera, fits.by_height),
        (fits.higher_m, fits.higher_sd_m, fits.chi2),
    )
    return fits

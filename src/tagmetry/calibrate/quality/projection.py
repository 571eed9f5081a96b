"""How far off a camera puts a point on the image, everywhere on the image.

The covariance of the intrinsics carried to pixels, after the motion of the camera that an error of
the intrinsics implies (see `motion`). It is small where boards were seen, and grows where the lens
model has to guess: at the corners that no board reached.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.quality.motion import ImpliedMotion, implied_motion
from tagmetry.calibrate.quality.solved import honest_covariance
from tagmetry.calibrate.result import Calibration
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array

_FAR_M = 1e6  # no translation of a camera shows in the picture of what is so far


@dataclass(frozen=True, eq=False)
class ProjectionUncertainty:
    """How uncertain projections are on a grid over the image; NaN where the lens shows nothing.

    Attributes:
        pixels: The grid, from corner to corner of the image, shape (rows, columns, 2).
        covariance_px2: Shape (rows, columns, 2, 2).
        distance_m: How far the points are from the camera; infinity for directions.
    """

    pixels: Array
    covariance_px2: Array
    distance_m: float

    @property
    def sd_px(self) -> Array:
        """Standard deviation in the worst direction, shape (rows, columns)."""
        a, c = self.covariance_px2[..., 0, 0], self.covariance_px2[..., 1, 1]
        b = self.covariance_px2[..., 0, 1]
        largest = (a + c) / 2 + np.hypot((a - c) / 2, b)
        return np.asarray(np.sqrt(largest))

    @property
    def sd_xy_px(self) -> Array:
        """Standard deviations along the rows and the columns, shape (rows, columns, 2)."""
        return np.asarray(np.sqrt(np.einsum("...ii->...i", self.covariance_px2)))

    @property
    def worst_px(self) -> float:
        """The largest over the image; NaN where the lens shows none of it."""
        return float(self.sd_px.flat[self._worst]) if self._shown.any() else np.nan

    @property
    def worst_pixel(self) -> tuple[float, float]:
        """Where it is largest."""
        u, v = self.pixels.reshape(-1, 2)[self._worst]
        return float(u), float(v)

    @property
    def middle_px(self) -> float:
        """Median over the image."""
        return float(np.median(self.sd_px[self._shown])) if self._shown.any() else np.nan

    @property
    def unshown_share(self) -> float:
        """Share of the grid, 0 to 1, on which the lens model shows nothing."""
        return float(1 - self._shown.mean())

    @property
    def _shown(self) -> Array:
        return np.isfinite(self.sd_px)

    @property
    def _worst(self) -> int:
        return int(np.argmax(np.nan_to_num(self.sd_px, nan=-1.0)))


def projection_uncertainty(
    calibration: Calibration,
    columns: int = 20,
    rows: int = 15,
    distance_m: float = np.inf,
    covariance: Array | None = None,
) -> ProjectionUncertainty:
    """Return how uncertain the camera's projections are over its whole image.

    Args:
        calibration: What was solved.
        columns: Of the grid.
        rows: Of the grid.
        distance_m: Of the points from the camera; infinity for directions.
        covariance: Of the intrinsics, shape (4 + c, 4 + c); None takes the camera's own.

    Raises:
        InputError: A grid of fewer than 2x2, a distance that is not positive, no covariance.
    """
    if not distance_m > 0:
        raise InputError(f"distance_m must be positive, got {distance_m}")
    if covariance is None:
        covariance = honest_covariance(calibration)
    motion = motion_of_views(calibration)
    pixels = image_grid(calibration.camera, columns, rows)
    remaining = at_pixels(motion, pixels, distance_m)
    carried = remaining @ covariance @ np.swapaxes(remaining, -1, -2)
    return ProjectionUncertainty(pixels, carried, distance_m)


def motion_of_views(calibration: Calibration) -> ImpliedMotion:
    """Return the motion that the corners a calibration used imply."""
    Ts = calibration.Ts_camera_board
    points = [
        Ts[i].apply(calibration.p_board[view.points[kept]])
        for i, (view, kept) in enumerate(zip(calibration.views, calibration.kept, strict=True))
    ]
    return implied_motion(calibration.camera, np.concatenate(points))


def at_pixels(motion: ImpliedMotion, pixels: Array, distance_m: float = np.inf) -> Array:
    """Return d(pixel) / d(intrinsics) with the motion made up for, shape (..., 2, 4 + c).

    Args:
        motion: What makes up for a change.
        pixels: Shape (..., 2).
        distance_m: Of what the pixels show.
    """
    return motion.remaining(motion.camera.unproject(pixels) * min(distance_m, _FAR_M))


def image_grid(camera: Camera, columns: int, rows: int) -> Array:
    """Return pixels from corner to corner of a camera's image, shape (rows, columns, 2).

    Raises:
        InputError: Fewer than two columns or rows.
    """
    if columns < 2 or rows < 2:
        raise InputError(f"expected a grid of at least 2x2, got {columns}x{rows}")
    u = np.linspace(0, camera.width_px - 1, columns)
    v = np.linspace(0, camera.height_px - 1, rows)
    return np.stack(np.meshgrid(u, v), axis=-1)

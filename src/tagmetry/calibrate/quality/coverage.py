"""What the views show: which parts of the image, at which tilts and distances.

Frames: `board` as its maker says, `camera` x right, y down, z forward.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.result import Calibration
from tagmetry.errors import InputError
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import IntArray


@dataclass(frozen=True, eq=False)
class Coverage:
    """Where corners were seen, and how the board was held.

    Attributes:
        cells: How many corners lie in each cell of the image, shape (rows, columns).
        rings: How many lie in ten rings of one width around the image's centre, shape (10,).
        farthest_share: How far out a corner lies, 1 at the image's own corners.
        tilts_deg: Angle between the board's normal and the line to the camera, shape (views,).
        tilt_directions_deg: To which side of the picture the face is turned, -180 to 180, 0 to the
            right, 90 to the bottom, shape (views,).
        distances_m: From the camera to the board's middle, shape (views,).
    """

    cells: IntArray
    rings: IntArray
    farthest_share: float
    tilts_deg: Array
    tilt_directions_deg: Array
    distances_m: Array

    @property
    def share(self) -> float:
        """Share of the cells, 0 to 1, in which there is a corner."""
        return float((self.cells > 0).mean())


def coverage(calibration: Calibration, columns: int = 8, rows: int = 6) -> Coverage:
    """Return what a calibration's views cover.

    Args:
        calibration: Only corners that were kept count.
        columns: Cells in a row.
        rows: Rows of cells.

    Raises:
        InputError: No cells.
    """
    each = zip(calibration.views, calibration.kept, strict=True)
    pixels = np.concatenate([view.corners_px[kept] for view, kept in each])
    size_px = calibration.camera.size_px
    centre = (np.array(size_px) - 1) / 2
    out = np.linalg.norm(pixels - centre, axis=1) / np.hypot(*centre)
    middle = np.nanmean(calibration.p_board, axis=0)
    tilts, directions = facing_deg(calibration.Ts_camera_board, middle)
    return Coverage(
        cells=cells_of(pixels, size_px, columns, rows),
        rings=np.histogram(out, bins=10, range=(0, 1))[0],
        farthest_share=float(out.max()),
        tilts_deg=tilts,
        tilt_directions_deg=directions,
        distances_m=np.linalg.norm(calibration.Ts_camera_board.apply(middle), axis=1),
    )


def cells_of(pixels: Array, size_px: tuple[int, int], columns: int, rows: int) -> IntArray:
    """Return how many pixels (n, 2) lie in each cell of an image, shape (rows, columns)."""
    if columns < 1 or rows < 1:
        raise InputError(f"expected at least one cell, got {columns}x{rows}")
    low, high = -0.5, np.array(size_px) - 0.5
    counts, _, _ = np.histogram2d(
        pixels[:, 1], pixels[:, 0], (rows, columns), [(low, high[1]), (low, high[0])]
    )
    return counts.astype(np.int64)


def facing_deg(Ts_camera_board: RigidTransform, middle: Array) -> tuple[Array, Array]:
    """Return tilts and the sides of the picture that faces are turned to, shape (n,) each."""
    places = np.asarray(Ts_camera_board.apply(middle))
    to_camera = -places / np.linalg.norm(places, axis=-1, keepdims=True)
    normal = Ts_camera_board.rotation.apply([0.0, 0.0, 1.0])
    tilt = np.arccos(np.clip((normal * to_camera).sum(axis=-1), -1, 1))
    aside = normal - (normal * to_camera).sum(axis=-1, keepdims=True) * to_camera
    return np.degrees(tilt), np.degrees(np.arctan2(aside[..., 1], aside[..., 0]))

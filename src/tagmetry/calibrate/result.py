"""What a calibration gives: the camera with its covariance, and all that shows how it came about.

Frames: `board` as its maker says, `camera` x right, y down, z forward.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.choice import ModelChoice
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray


@dataclass(frozen=True, eq=False)
class Calibration:
    """A camera solved from views of a board.

    Attributes:
        camera: The camera; its covariance holds when the errors of one view depend on each other.
        formula_covariance: s^2 (J^T W J)^-1 over the same numbers: what other programs print, too
            small where the errors of a view depend on each other.
        views: The views that were used.
        Ts_camera_board: Where the board was in each of them.
        residuals_px: Seen minus predicted, (n, 2) for each view, rejected corners too.
        kept: Which corners of each view were used, (n,); False is an outlier.
        p_board: The board's points as solved, row k is point k, shape (points, 3), metres; NaN
            for points that no view shows.
        shape_released: Whether the points were free to leave the maker's places.
        rejected: The views that were not used.
        choice: The lens models that were compared, where that was asked for.
        warnings: What to know before trusting the result, in words.
    """

    camera: Camera
    formula_covariance: Array
    views: tuple[BoardView, ...]
    Ts_camera_board: RigidTransform
    residuals_px: tuple[Array, ...]
    kept: tuple[BoolArray, ...]
    p_board: Array
    shape_released: bool
    rejected: tuple[RejectedView, ...] = ()
    choice: ModelChoice | None = None
    warnings: tuple[str, ...] = ()

    @property
    def rms_px(self) -> float:
        """Root of the mean squared 2-D error of the kept corners, as OpenCV counts it."""
        errors = np.concatenate(self._kept_residuals())
        return float(np.sqrt((errors**2).sum(axis=1).mean()))

    @property
    def view_rms_px(self) -> Array:
        """The same for each view, shape (views,)."""
        return np.array([np.sqrt((e**2).sum(axis=1).mean()) for e in self._kept_residuals()])

    @property
    def tutorial_error_px(self) -> float:
        """The error as seed 003 and OpenCV's tutorial count it: mean of norm / points per view.

        It is smaller than `rms_px` by the root of the number of points: two programs' errors
        compare only when both count the same way.
        """
        return float(np.mean([np.linalg.norm(e) / len(e) for e in self._kept_residuals()]))

    def _kept_residuals(self) -> list[Array]:
        return [e[kept] for e, kept in zip(self.residuals_px, self.kept, strict=True)]

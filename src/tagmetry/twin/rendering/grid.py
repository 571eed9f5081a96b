"""A piece of the image, divided finer than pixels, and where its rays meet a sheet."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.twin.optics.rays import Rays
from tagmetry.twin.rendering.box import Box
from tagmetry.twin.rendering.finer import finer
from tagmetry.twin.rendering.hits import hits_m


@dataclass(frozen=True)
class Grid:
    """A piece of an image on a fine grid.

    Attributes:
        camera: Whose image it is.
        box: Which pixels; they may lie outside the image.
        fine: Points along a pixel's side.
    """

    camera: Camera
    box: Box
    fine: int

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns) of its points."""
        height, width = self.box.bottom - self.box.top, self.box.right - self.box.left
        return self.fine * height, self.fine * width

    @property
    def rows_px(self) -> Array:
        """Where its rows of points begin and end, shape (rows + 1,)."""
        return self.box.top - 0.5 + np.arange(self.shape[0] + 1) / self.fine

    @cached_property
    def rays(self) -> Array:
        """Viewing directions of its points' corners, shape (rows + 1, columns + 1, 3)."""
        u = np.arange(self.box.left - 1, self.box.right + 2) - 0.5
        v = np.arange(self.box.top - 1, self.box.bottom + 2) - 0.5
        return finer(Rays(self.camera).look(*np.meshgrid(u, v)), self.fine)

    def hits_m(self, box: Box, Ts_camera_sheet: RigidTransform) -> tuple[Array, Array]:
        """Return where the rays of a box within the grid's meet a sheet.

        Args:
            box: Pixels of the grid.
            Ts_camera_sheet: One pose, or one for each of `rows_px`.

        Returns:
            x and y on the sheet at the corners of the box's points, metres; NaN where none.
        """
        rows, columns = box.inside(self.box, self.fine)
        rows = slice(rows.start, rows.stop + 1)
        columns = slice(columns.start, columns.stop + 1)
        if not Ts_camera_sheet.single:
            Ts_camera_sheet = Ts_camera_sheet[rows]
        return hits_m(self.rays[rows, columns], Ts_camera_sheet)

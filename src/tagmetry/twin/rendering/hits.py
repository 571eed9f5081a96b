"""Where viewing rays meet a sheet's plane."""

import numpy as np
from numba import njit

from tagmetry.geometry import Array, RigidTransform


def hits_m(rays: Array, Ts_camera_sheet: RigidTransform) -> tuple[Array, Array]:
    """Return where rays (h, w, 3) meet a sheet: x and y in its frame, (h, w); NaN where behind.

    Args:
        rays: Viewing directions in the camera frame.
        Ts_camera_sheet: Where the sheet is, one pose, or one for every row of rays.
    """
    R_camera_sheet = np.ascontiguousarray(Ts_camera_sheet.rotation.as_matrix().reshape(-1, 3, 3))
    t_camera = np.asarray(Ts_camera_sheet.translation).reshape(-1, 3)
    camera_in_sheet = -np.einsum("kij,ki->kj", R_camera_sheet, t_camera)
    return _hits(rays, R_camera_sheet, camera_in_sheet)


@njit(cache=True, nogil=True)
def _hits(rays: Array, R_camera_sheet: Array, camera_in_sheet: Array) -> tuple[Array, Array]:
    height, width = rays.shape[0], rays.shape[1]
    x, y = np.full((height, width), np.nan), np.full((height, width), np.nan)
    for row in range(height):
        pose = row if len(R_camera_sheet) > 1 else 0
        R, camera = R_camera_sheet[pose], camera_in_sheet[pose]
        for column in range(width):
            a, b, c = rays[row, column]
            fall = R[0, 2] * a + R[1, 2] * b + R[2, 2] * c
            if fall != 0.0 and camera[2] / fall < 0.0:
                reach = -camera[2] / fall
                x[row, column] = camera[0] + reach * (R[0, 0] * a + R[1, 0] * b + R[2, 0] * c)
                y[row, column] = camera[1] + reach * (R[0, 1] * a + R[1, 1] * b + R[2, 1] * c)
    return x, y

"""The world of one trajectory in that of another, by their ways.

    minimise sum |p_true_i - (R p_i + t)|^2,    without a scale: a metre is a metre

Reference: Horn 1987; Umeyama 1991, equations 40 to 42 with c = 1.
"""

from typing import Literal

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.localize.trajectory.matching import Matched

Alignment = Literal["none", "path"]

_STRAIGHT = 1e-3  # a way's width by its length, below which a turn about it is not told


def path_alignment(both: Matched) -> RigidTransform:
    """Return T_true_estimated, from the world of the estimated poses to that of the true ones.

    Raises:
        InputError: The way is too short or too straight to tell how the worlds are turned.
    """
    estimated, true = both.estimated.positions_m, both.true.positions_m
    middle, true_middle = estimated.mean(axis=0), true.mean(axis=0)
    mixed = (true - true_middle).T @ (estimated - middle)
    U, widths2, Vt = np.linalg.svd(mixed)
    if len(true) < 3 or not widths2[1] > _STRAIGHT**2 * widths2[0]:
        raise InputError(
            f"the way is too straight to align the worlds by: {len(true)} common poses nearly in a "
            f"line; compare without an alignment"
        )
    mirror = np.diag([1.0, 1.0, np.linalg.det(U) * np.linalg.det(Vt)])
    R = Rotation.from_matrix(U @ mirror @ Vt)
    return RigidTransform.from_components(true_middle - R.apply(middle), R)

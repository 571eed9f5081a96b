"""How much each view decides: how far projections would move without it.

To first order the camera without a view differs by -(H - I_v)^-1 g_v, with I_v and g_v what the
view alone tells of the intrinsics and H what all tell; nothing is solved anew.

Reference: R. D. Cook, Detection of Influential Observation in Linear Regression, 1977.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.quality.projection import at_pixels, image_grid, motion_of_views
from tagmetry.calibrate.quality.solved import Solved, view_equations
from tagmetry.calibrate.result import Calibration
from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class ViewInfluence:
    """What each view does to the camera; NaN where the others alone determine none.

    Attributes:
        shift_px: How far projections move without the view, root mean square over the image, after
            the implied motion, shape (views,).
        worst_shift_px: The largest over the image, shape (views,).
        information_share: What the view tells of the camera's numbers, of what all tell; the shares
            add up to one, shape (views,).
    """

    shift_px: Array
    worst_shift_px: Array
    information_share: Array


def view_influence(calibration: Calibration, columns: int = 12, rows: int = 9) -> ViewInfluence:
    """Return how much each view decides.

    Args:
        calibration: What was solved from all views.
        columns: Of the grid of pixels.
        rows: Of the grid of pixels.

    Raises:
        InputError: A grid of fewer than 2x2.
    """
    solved = Solved.of(calibration)
    informations, gradients = view_equations(solved.bundle, solved.seen, solved.freedom)
    changes = -_solved(informations.sum(axis=0) - informations, gradients[..., None])
    pixels = image_grid(calibration.camera, columns, rows)
    to_pixels = at_pixels(motion_of_views(calibration), pixels) @ solved.freedom.basis
    shifts = np.linalg.norm(np.tensordot(changes[..., 0], to_pixels, axes=(1, 3)), axis=-1)
    shifts = shifts.reshape(len(changes), -1)
    shown = np.isfinite(to_pixels).all(axis=(2, 3)).ravel()
    return ViewInfluence(
        np.sqrt((shifts[:, shown] ** 2).mean(axis=1)),
        shifts[:, shown].max(axis=1),
        _shares(informations),
    )


def _solved(matrices: Array, columns: Array) -> Array:
    """Return A^-1 b of each; NaN where A is singular to rounding."""
    usable = np.linalg.cond(matrices) < 1e12
    safe = np.where(usable[:, None, None], matrices, np.eye(matrices.shape[-1]))
    return np.where(usable[:, None, None], np.linalg.solve(safe, columns), np.nan)


def _shares(informations: Array) -> Array:
    """Return tr(I_v H^-1) / c for each view, H the sum of all I_v."""
    total = informations.sum(axis=0)
    shares = np.trace(np.linalg.solve(total, informations), axis1=1, axis2=2) / len(total)
    return np.asarray(shares)

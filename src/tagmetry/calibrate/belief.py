"""How far a board may be from what its maker says, before any picture is looked at."""

import numpy as np

from tagmetry.geometry import Array

_SHARES = np.array([0.002, 0.002, 0.01])  # of the diagonal: print, in the plane; bow, out of it


def shape_belief_m(p_board: Array) -> Array:
    """Return a point's standard deviation along each axis of the board, shape (3,).

    It is 0.2 % of the board's diagonal along the axes of its plane (a printer's scale and paper
    that shrinks) and 1 % out of it (a bow).

    Args:
        p_board: The points where the board's maker put them, shape (k, 3).
    """
    return np.asarray(np.linalg.norm(np.ptp(p_board, axis=0)) * _SHARES)

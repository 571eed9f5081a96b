"""How often the wrong one of a flat marker's two poses will fit better.

The wrong pose shows the corners d standard deviations from where they are; it fits better with the
probability Q(d / 2). Where a marker faces the camera so squarely that the corners without noise
have one pose only, noise makes two of it: then it is the mean of what poses of noisy corners say.
"""

from functools import lru_cache

import numpy as np
from scipy.stats import norm, qmc

from tagmetry.geometry import Array
from tagmetry.pose.marker import solve
from tagmetry.pose.plan.setup import Setup
from tagmetry.pose.result import PoseHypothesis

_DRAWS_LOG2 = 7


def flip_probability(setup: Setup, corners_cov_px2: Array) -> float:
    """Return the probability, 0 to 0.5.

    Args:
        setup: What is planned.
        corners_cov_px2: Covariance of the corners, shape (8, 8).
    """
    exact = _hypotheses(setup, setup.corners_px[None], corners_cov_px2)[0]
    if len(exact) == 2:
        return float(norm.sf(np.sqrt(exact[1].chi2) / 2))
    noise_px = _spread_normals() @ np.linalg.cholesky(corners_cov_px2).T
    drawn = _hypotheses(setup, setup.corners_px + noise_px.reshape(-1, 4, 2), corners_cov_px2)
    return float(np.mean([1 - found[0].probability for found in drawn if found]))


def _hypotheses(
    setup: Setup, corners_px: Array, corners_cov_px2: Array
) -> list[tuple[PoseHypothesis, ...]]:
    """Return the poses of each of n markers' corners (n, 4, 2)."""
    count = len(corners_px)
    noise = np.broadcast_to(corners_cov_px2, (count, 8, 8))
    return solve(corners_px, noise, np.full(count, setup.size_m), setup.camera)


@lru_cache
def _spread_normals() -> Array:
    """Return standard normal numbers that fill the space evenly, shape (n, 8)."""
    even = qmc.Sobol(8, scramble=False).random_base2(_DRAWS_LOG2)
    return np.asarray(norm.ppf((even + 0.5 / len(even)) % 1.0))

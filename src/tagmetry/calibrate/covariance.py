"""How far the camera's numbers may be off: two answers.

The formula, s^2 (J^T W J)^-1, holds when every corner errs by itself. In real pictures the corners
of a view err together (a bent board, light, motion, a lens that no model fits quite), and the
truth is farther away than the formula says: 2.5 to 3.4 times for the principal point of OpenCV's
own example pictures.

The sandwich by view takes only the views to be independent. With g_v a view's part of the
gradient and M_v the correction for what its errors lost by being fitted (R. Bell, D. McCaffrey,
Bias reduction in standard errors for linear regression with multi-stage samples, 2002; CR2),

    C = S^-1 (sum M_v g_v g_v^T M_v) S^-1        S the information

From n views it is known to about n degrees of freedom only: its small axes come out too small. So
it is drawn towards the formula's shape, as far as its own scatter says it must (O. Ledoit,
M. Wolf, A well-conditioned estimator for large-dimensional covariance matrices, 2004), and it
grows by as much of Hotelling's factor as stays of it. The usual ellipsoid, chi^2 below its 95 %
point, then contains the truth in about 95 % of cases; single standard deviations err to the large
side when views are few.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import stats

from tagmetry.calibrate.bundle import Bundle, Freedom, Linear, linearise
from tagmetry.calibrate.normal import eliminate_poses, normal_equations
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.solve import shape_prior
from tagmetry.geometry import Array


@dataclass(frozen=True, eq=False)
class Covariances:
    """Over fx, fy, cx, cy and the coefficients, shape (4 + c, 4 + c) each.

    Attributes:
        formula: s^2 (J^T W J)^-1.
        by_view: The sandwich by view.
    """

    formula: Array
    by_view: Array


def covariances(bundle: Bundle, seen: Sightings, freedom: Freedom) -> Covariances:
    """Return both covariances of the intrinsics at a solution.

    Args:
        bundle: The solution.
        seen: The corners that it fits, those that were dropped with no weight.
        freedom: What was free in it; numbers that were not have no variance.

    Raises:
        LinAlgError: The views do not determine the camera.
    """
    linear = linearise(bundle, seen, freedom)
    information, _ = eliminate_poses(normal_equations(linear, seen.weights, freedom))
    information += np.diag(_prior(bundle, seen, freedom))
    scale = np.sqrt(np.diag(information))
    inverse = np.linalg.inv(information / np.outer(scale, scale)) / np.outer(scale, scale)
    c = freedom.count
    root = np.linalg.cholesky(inverse[:c, :c])
    scores = np.array(
        [_unbiased(own, g, inverse, root) for own, g in _by_view(linear, seen, freedom)]
    )
    to_intrinsics = freedom.basis @ root
    formula = _unit_variance(linear, seen, freedom) * np.eye(c)
    return Covariances(
        to_intrinsics @ formula @ to_intrinsics.T,
        to_intrinsics @ drawn_to_round(scores) @ to_intrinsics.T,
    )


def drawn_to_round(scores: Array) -> Array:
    """Return sum s s^T, drawn to a multiple of the identity as far as it is uncertain.

    Args:
        scores: One for each view, in units in which the formula's covariance is the identity,
            shape (n, c).

    Returns:
        Shape (c, c), grown so that it can be used as if it were known exactly.
    """
    n, c = scores.shape
    each = n * scores[:, :, None] * scores[:, None, :]
    mean = each.mean(axis=0)
    level = np.trace(mean) / c
    apart = ((mean - level * np.eye(c)) ** 2).sum()
    scatter = ((each - mean) ** 2).sum() / n**2
    share = float(min(scatter / apart, 1.0)) if apart > 0 else 1.0
    grown = 1 + (1 - share) * (_hotelling(n, c) - 1)
    return np.asarray(grown * ((1 - share) * mean + share * level * np.eye(c)))


def _hotelling(n: int, c: int) -> float:
    """Return by how much a covariance from n samples must grow for 95 % to be within."""
    freedom = max(n - 1, c + 1)
    limit = c * freedom / (freedom - c + 1) * stats.f.ppf(0.95, c, freedom - c + 1)
    return float(limit / stats.chi2.ppf(0.95, c))


def _by_view(linear: Linear, seen: Sightings, freedom: Freedom) -> Iterator[tuple[Array, Array]]:
    """Give each view's own information (m, m) and gradient (m,) of the shared numbers."""
    for v in range(len(seen)):
        one = slice(v, v + 1)
        yield eliminate_poses(normal_equations(linear.only(one), seen.weights[one], freedom))


def _unbiased(own: Array, gradient: Array, inverse: Array, root: Array) -> Array:
    """Return what a view's errors do to the free intrinsics in units of `root`, shape (c,).

    Errors that are free would have the covariance B, those left by the fit have D; the score is
    multiplied by the symmetric M with M D M = B, so that its square has the right mean.
    """
    c = len(root)
    to_score = np.linalg.solve(root, inverse[:c])
    B = to_score @ own @ to_score.T
    D = B - to_score @ own @ inverse @ own @ to_score.T
    half = _power(B, 0.5)
    M = half @ _power(half @ D @ half, -0.5) @ half
    return np.asarray(M @ (to_score @ gradient))


def _power(symmetric: Array, exponent: float) -> Array:
    """Return a power of a positive semidefinite matrix; directions of no size stay of none."""
    values, vectors = np.linalg.eigh(symmetric)
    kept = values > 1e-10 * max(values[-1], 1e-300)
    powers = np.where(kept, np.where(kept, values, 1.0) ** exponent, 0.0)
    return np.asarray(vectors * powers @ vectors.T)


def _prior(bundle: Bundle, seen: Sightings, freedom: Freedom) -> Array:
    none = np.zeros(freedom.count)
    if freedom.shape_sd_m is None:
        return none
    return np.append(none, shape_prior(bundle, seen, freedom.shape_sd_m)[0])


def _unit_variance(linear: Linear, seen: Sightings, freedom: Freedom) -> float:
    """Return s^2: the mean squared error in units of the corners' own sd, per spare equation."""
    cost = float((seen.weights[..., None] * linear.error**2).sum())
    unknowns = freedom.count + 6 * len(seen)
    if freedom.shape_sd_m is not None:
        unknowns += 3 * len(seen.points) - 7
    return cost / max(2 * seen.corner_count - unknowns, 1)

"""How far the camera's numbers may be off: two answers.

The formula, s^2 (J^T W J)^-1, holds when every corner errs by itself. In real pictures the corners
of a view err together (a bent board, light, motion, a lens that no model fits quite), and the
truth is farther away than the formula says: 2.5 to 3.4 times for the principal point of OpenCV's
own example pictures.

The sandwich by view takes only the views to be independent. With g_v a view's part of the
gradient and M_v the correction for what its errors lost by being fitted (R. Bell, D. McCaffrey,
Bias reduction in standard errors for linear regression with multi-stage samples, 2002; CR2),

    C = S^-1 (sum M_v g_v g_v^T M_v) S^-1        S the information

From n views it is known to about n degrees of freedom only. Where every corner errs by itself its
ellipsoid has the right size in the mean and yet holds the truth in 92 to 93 % of cases from 35
views (bias is no part of that: the estimate is off by less than a tenth of its standard deviation),
while the formula holds it in 95 %. So the formula is what is believed, and the sandwich changes it
only as far as its own scatter lets it, in three steps, in units that make the formula s^2 I:

1. The level, its mean variance, leaves s^2 as far as the difference exceeds the scatter that a
   level from n views has (W. James, C. Stein, 1961), and upwards only.
2. The shape leaves the round one in the same way (O. Ledoit, M. Wolf, A well-conditioned estimator
   for large-dimensional covariance matrices, 2004). What stays of the sandwich grows by as much of
   Hotelling's factor: it is known from a sample only.
3. No direction is surer than the formula.

The usual ellipsoid, chi^2 below its 95 % point, then holds the truth in 95 to 97 % of cases with 35
views, whether corners err by themselves or a view's err together. It is less (about 90 %) where
they share errors too small to be told from noise by so few views, and single standard deviations
err to the large side with fewer than 20 views. What all views share (a bent board taken for flat)
no sandwich by view sees: release the board's shape.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy import special

from tagmetry.calibrate.bundle import Bundle, Freedom, Linear, linearise
from tagmetry.calibrate.normal import eliminate_poses, normal_equations
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.solve import shape_prior
from tagmetry.geometry import Array

_OPEN = 1e-9  # share of a number's information that its correlation with others leaves


@dataclass(frozen=True, eq=False)
class Covariances:
    """Over fx, fy, cx, cy and the coefficients, shape (4 + c, 4 + c) each.

    Attributes:
        formula: s^2 (J^T W J)^-1.
        by_view: The formula, and the sandwich by view as far as it is known to differ.
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
    information, _ = eliminate_poses(normal_equations(linear, freedom))
    information += np.diag(_prior(bundle, seen, freedom))
    scale, c = np.sqrt(np.diag(information)), freedom.count
    alike = information / np.outer(scale, scale)
    inverse = np.linalg.inv(alike) / np.outer(scale, scale)
    root = _root_of_covariance(alike, c) / scale[:c, None]
    told = [_unbiased(own, g, inverse, root) for own, g in _by_view(linear, seen, freedom)]
    scores, parts = (np.array(rows) for rows in zip(*told, strict=True))
    s2 = _unit_variance(linear, seen, freedom)
    to_intrinsics = freedom.basis @ root
    return Covariances(
        to_intrinsics @ (s2 * np.eye(c)) @ to_intrinsics.T,
        to_intrinsics @ drawn_to_formula(scores, parts, s2) @ to_intrinsics.T,
    )


def drawn_to_formula(scores: Array, parts: Array, s2: float) -> Array:
    """Return sum s s^T, drawn to the formula's s^2 I as far as it is uncertain.

    Args:
        scores: One for each view, in units in which the formula's covariance is s^2 I, (n, c).
        parts: Their covariances over s^2 if the formula holds, shape (n, c, c), sum the identity.
        s2: The formula's variance.

    Returns:
        Shape (c, c), nowhere below s^2, grown so that it can be used as if it were known exactly.
    """
    n, c = scores.shape
    each = scores[:, :, None] * scores[:, None, :]
    found, level = each.sum(axis=0), _level(scores, parts, s2)
    scatter = ((each - level * parts) ** 2).sum()
    drawn = _share(scatter, ((found - level * np.eye(c)) ** 2).sum())
    mixed = (1 - drawn) * found + drawn * level * np.eye(c)
    return _at_least(s2, mixed * (1 + (1 - drawn) * (_hotelling(n, c) - 1)))


def _level(scores: Array, parts: Array, s2: float) -> float:
    """Return the scores' mean variance over the directions, drawn to s^2 and not below it."""
    c = scores.shape[1]
    beyond = float((scores**2).sum()) / c - s2
    scatter = 2 * float((parts**2).sum()) * (s2 / c) ** 2  # of a sum of squares of normal numbers
    return float(s2 + max((1 - _share(scatter, beyond**2)) * beyond, 0.0))


def _share(scatter: float, squared: float) -> float:
    """Return which share of a squared difference is to be expected from scatter, 0 to 1."""
    return float(min(scatter / squared, 1.0)) if squared > 0 else 1.0


def _at_least(least: float, symmetric: Array) -> Array:
    """Return a covariance with no variance along any direction below the least."""
    values, vectors = np.linalg.eigh(symmetric)
    return np.asarray(vectors * np.maximum(values, least) @ vectors.T)


def _hotelling(n: int, c: int) -> float:
    """Return by how much a covariance from n samples must grow for 95 % to be within."""
    freedom = max(n - 1, c + 1)
    limit = c * freedom / (freedom - c + 1) * special.fdtri(c, freedom - c + 1, 0.95)
    return float(limit / special.chdtri(c, 0.05))


def _root_of_covariance(information: Array, c: int) -> Array:
    """Return R with R R^T the covariance (c, c) of the first numbers, the others unknown too.

    It comes from the information itself: the inverse of one that is nearly open has lost the
    directions that are known best.

    Raises:
        LinAlgError: The information leaves a direction of these numbers open.
    """
    order = np.roll(np.arange(len(information)), -c)
    own = np.linalg.cholesky(information[np.ix_(order, order)])[-c:, -c:]
    sizes = np.linalg.norm(own, axis=1, keepdims=True)
    if np.linalg.svd(own / sizes, compute_uv=False)[-1] ** 2 < _OPEN:
        raise np.linalg.LinAlgError("a direction of the camera's numbers is open")
    return np.asarray(np.linalg.inv(own).T)


def _by_view(linear: Linear, seen: Sightings, freedom: Freedom) -> Iterator[tuple[Array, Array]]:
    """Give each view's own information (m, m) and gradient (m,) of the shared numbers."""
    for v in range(len(seen)):
        one = slice(v, v + 1)
        yield eliminate_poses(normal_equations(linear.only(one), freedom))


def _unbiased(own: Array, gradient: Array, inverse: Array, root: Array) -> tuple[Array, Array]:
    """Return what a view's errors do to the free intrinsics in units of `root`, (c,), and B.

    Errors that are free would have the covariance B, those left by the fit have D; the score is
    multiplied by the symmetric M with M D M = B, so that its square has the right mean.
    """
    c = len(root)
    to_score = np.linalg.solve(root, inverse[:c])
    B = to_score @ own @ to_score.T
    D = B - to_score @ own @ inverse @ own @ to_score.T
    half = _power(B, 0.5)
    M = half @ _power(half @ D @ half, -0.5) @ half
    return np.asarray(M @ (to_score @ gradient)), B


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
    cost = float((linear.error**2).sum())
    unknowns = freedom.count + 6 * len(seen)
    if freedom.shape_sd_m is not None:
        unknowns += 3 * len(seen.points) - 7
    return cost / max(2 * seen.corner_count - unknowns, 1)

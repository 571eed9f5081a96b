"""OpenCV's polynomial distortion with up to 14 coefficients, its Jacobians and its inverse.

With x = X / Z, y = Y / Z, r^2 = x^2 + y^2 and (k1 k2 p1 p2 k3 k4 k5 k6 s1 s2 s3 s4 tx ty):

    g  = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
    x' = x g + 2 p1 x y + p2 (r^2 + 2 x^2) + s1 r^2 + s2 r^4
    y' = y g + p1 (r^2 + 2 y^2) + 2 p2 x y + s3 r^2 + s4 r^4
    (x'', y'', 1) ~ M(tx, ty) (x', y', 1)        a sensor tilted by tx and ty

Seed 001 (its equations 4 and 6) adds the undistorted point twice; here it is counted once.
"""

import numpy as np

from tagmetry.camera.fold import least_positive_root
from tagmetry.geometry.arrays import Array

COEFFICIENTS = 14
_SLOPE = np.array([1.0, 3.0, 5.0, 7.0])  # d(r q^i) / dr = (2 i + 1) q^i with q = r^2


def distort(xy: Array, coefficients: Array) -> Array:
    """Return where the lens puts ideal points.

    Args:
        xy: Ideal normalised points, shape (..., 2).
        coefficients: Shape (14,), missing ones zero.
    """
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4 = coefficients[:12]
    x, y = xy[..., 0], xy[..., 1]
    r2 = x * x + y * y
    gain = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    bent_x = x * gain + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + r2 * (s1 + r2 * s2)
    bent_y = y * gain + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + r2 * (s3 + r2 * s4)
    bent = np.stack([bent_x, bent_y], axis=-1)
    if coefficients[12] == 0 and coefficients[13] == 0:
        return bent
    return _through(tilt_matrix(*coefficients[12:]), bent)


def jacobian_by_point(xy: Array, coefficients: Array) -> Array:
    """Return d(distorted) / d(ideal), shape (..., 2, 2)."""
    k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4 = coefficients[:12]
    x, y = xy[..., 0], xy[..., 1]
    r2 = x * x + y * y
    above, below = 1 + r2 * (k1 + r2 * (k2 + r2 * k3)), 1 + r2 * (k4 + r2 * (k5 + r2 * k6))
    gain = above / below
    slope = ((k1 + r2 * (2 * k2 + 3 * r2 * k3)) - gain * (k4 + r2 * (2 * k5 + 3 * r2 * k6))) / below
    prism_x, prism_y = 2 * (s1 + 2 * r2 * s2), 2 * (s3 + 2 * r2 * s4)
    cross = 2 * slope * x * y + 2 * p1 * x + 2 * p2 * y
    xx = gain + 2 * slope * x * x + 2 * p1 * y + 6 * p2 * x + prism_x * x
    yy = gain + 2 * slope * y * y + 6 * p1 * y + 2 * p2 * x + prism_y * y
    rows = [[xx, cross + prism_x * y], [cross + prism_y * x, yy]]
    jacobian = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
    if coefficients[12] == 0 and coefficients[13] == 0:
        return jacobian
    untilted = distort(xy, np.append(coefficients[:12], [0.0, 0.0]))
    return np.asarray(_through_jacobian(tilt_matrix(*coefficients[12:]), untilted) @ jacobian)


def jacobian_by_coefficients(xy: Array, coefficients: Array, count: int = COEFFICIENTS) -> Array:
    """Return d(distorted) / d(coefficients), shape (..., 2, count).

    Args:
        xy: Ideal normalised points, shape (..., 2).
        coefficients: Shape (14,), missing ones zero.
        count: How many of them to derive by, from the first.
    """
    jacobian = np.zeros((*xy.shape[:-1], 2, COEFFICIENTS))
    _fill_polynomial(jacobian, xy, coefficients)
    if not (count > 12 or coefficients[12:].any()):
        return jacobian[..., :count]
    untilted = distort(xy, np.append(coefficients[:12], [0.0, 0.0]))
    tilt = tilt_matrix(*coefficients[12:])
    jacobian[..., :12] = _through_jacobian(tilt, untilted) @ jacobian[..., :12]
    jacobian[..., 12:] = _tilt_jacobian(untilted, *coefficients[12:])
    return jacobian[..., :count]


def _fill_polynomial(jacobian: Array, xy: Array, coefficients: Array) -> None:
    """Write the first 12 columns, those of a sensor that is not tilted."""
    k1, k2, _, _, k3, k4, k5, k6 = coefficients[:8]
    x, y = xy[..., 0], xy[..., 1]
    r2 = x * x + y * y
    below = 1 + r2 * (k4 + r2 * (k5 + r2 * k6))
    gain = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / below
    powers = np.stack([r2, r2**2, r2**3], axis=-1)
    by_above, by_below = powers / below[..., None], -powers * (gain / below)[..., None]
    for axis, along in enumerate((x, y)):
        jacobian[..., axis, 0:2] = along[..., None] * by_above[..., :2]
        jacobian[..., axis, 4] = along * by_above[..., 2]
        jacobian[..., axis, 5:8] = along[..., None] * by_below
        jacobian[..., axis, 8 + 2 * axis : 10 + 2 * axis] = powers[..., :2]
    jacobian[..., 0, 2], jacobian[..., 0, 3] = 2 * x * y, r2 + 2 * x * x
    jacobian[..., 1, 2], jacobian[..., 1, 3] = r2 + 2 * y * y, 2 * x * y


def undistort(bent: Array, coefficients: Array, fold_radius: float) -> Array:
    """Return the ideal points of distorted ones, by Newton's method with shortened steps.

    Args:
        bent: Distorted normalised points, shape (..., 2).
        coefficients: Shape (14,).
        fold_radius: Ideal radius up to which the distortion is one to one.

    Returns:
        Shape (..., 2); NaN where no ideal point within the fold radius is bent to there.
    """
    limit = min(fold_radius * (1 - 1e-9), 1e3)  # a pole of g may lie at the fold itself
    xy = _within(bent, 0.99 * limit)
    for _ in range(60):
        error = distort(xy, coefficients) - bent
        if not (np.abs(error) > 1e-13).any():
            break
        step = _solve_2x2(jacobian_by_point(xy, coefficients), error)
        reach = np.maximum(1.0, 2 * np.linalg.norm(step, axis=-1, keepdims=True) / (0.5 * limit))
        xy = _within(xy - step / reach, limit)
    error = np.linalg.norm(distort(xy, coefficients) - bent, axis=-1)
    found = (error < 1e-10) & (_determinant(jacobian_by_point(xy, coefficients)) > 0)
    return np.where(found[..., None], xy, np.nan)


def fold_radius(coefficients: Array) -> float:
    """Return the ideal radius at which the radial distortion stops growing, infinite if never.

    It is the least positive root of d(r g(r)) / dr, or the first pole of g.
    """
    k1, k2, _, _, k3, k4, k5, k6 = coefficients[:8]
    above, below = np.array([1.0, k1, k2, k3]), np.array([1.0, k4, k5, k6])  # rising, in r^2
    if not coefficients[5:8].any():
        return float(np.sqrt(least_positive_root(_SLOPE * above)))
    order = np.arange(4.0)
    slope = np.convolve(_SLOPE * above, below) - np.convolve(above, 2 * order * below)
    return float(np.sqrt(min(least_positive_root(p) for p in (slope, below))))


def tilt_matrix(tilt_x_rad: float, tilt_y_rad: float) -> Array:
    """Return M(tx, ty), shape (3, 3)."""
    return _flattened(_tilt_y(tilt_y_rad) @ _tilt_x(tilt_x_rad))


def _flattened(R: Array) -> Array:
    onto = np.array([[R[2, 2], 0.0, -R[0, 2]], [0.0, R[2, 2], -R[1, 2]], [0.0, 0.0, 1.0]])
    return np.asarray(onto @ R)


def _tilt_x(angle_rad: float) -> Array:
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])


def _tilt_y(angle_rad: float) -> Array:
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def _tilt_jacobian(bent: Array, tilt_x_rad: float, tilt_y_rad: float) -> Array:
    """Return d(tilted) / d(tx, ty), shape (..., 2, 2): M is linear in R but for the product."""
    quarter = np.pi / 2
    R_x, R_y = _tilt_x(tilt_x_rad), _tilt_y(tilt_y_rad)
    dR_x = _tilt_x(tilt_x_rad + quarter) - np.diag([1.0, 0.0, 0.0])
    dR_y = _tilt_y(tilt_y_rad + quarter) - np.diag([0.0, 1.0, 0.0])
    R = R_y @ R_x
    homogeneous = np.concatenate([bent, np.ones_like(bent[..., :1])], axis=-1)
    mapped = homogeneous @ _flattened(R).T
    columns = []
    for dR in (R_y @ dR_x, dR_y @ R_x):
        donto = np.array([[dR[2, 2], 0, -dR[0, 2]], [0, dR[2, 2], -dR[1, 2]], [0, 0, 0]])
        onto = np.array([[R[2, 2], 0, -R[0, 2]], [0, R[2, 2], -R[1, 2]], [0, 0, 1]])
        moved = homogeneous @ (donto @ R + onto @ dR).T
        columns.append(
            (moved[..., :2] - mapped[..., :2] / mapped[..., 2:] * moved[..., 2:]) / mapped[..., 2:]
        )
    return np.stack(columns, axis=-1)


def _through(M: Array, xy: Array) -> Array:
    mapped = xy @ M[:, :2].T + M[:, 2]
    return np.asarray(mapped[..., :2] / mapped[..., 2:])


def _through_jacobian(M: Array, xy: Array) -> Array:
    mapped = xy @ M[:, :2].T + M[:, 2]
    image = mapped[..., :2] / mapped[..., 2:]
    return np.asarray(
        (M[:2, :2] - image[..., :, None] * M[2, :2]) / mapped[..., 2][..., None, None]
    )


def _solve_2x2(matrix: Array, right: Array) -> Array:
    (a, b), (c, d) = np.moveaxis(matrix, (-2, -1), (0, 1))
    determinant = _determinant(matrix)
    determinant = np.where(np.abs(determinant) < 1e-12, 1e-12, determinant)
    x, y = right[..., 0], right[..., 1]
    return np.stack([d * x - b * y, a * y - c * x], axis=-1) / determinant[..., None]


def _determinant(matrix: Array) -> Array:
    (a, b), (c, d) = np.moveaxis(matrix, (-2, -1), (0, 1))
    return np.asarray(a * d - b * c)


def _within(xy: Array, radius: float) -> Array:
    length = np.linalg.norm(xy, axis=-1, keepdims=True)
    return np.asarray(xy * np.minimum(1.0, radius / np.maximum(length, 1e-300)))

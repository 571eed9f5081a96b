"""Small steps that compiled loops over robots share: angles, and matrices of three rows."""

import numpy as np
from numba import njit

from tagmetry.geometry import Array
from tagmetry.localize.joint.small import backward, cholesky, forward

# too short to let other threads have the interpreter: it would have to be waited for
kernel = njit(cache=True, error_model="numpy")


@kernel
def wrapped_rad(angle_rad: float) -> float:
    """Return the same direction in (-pi, pi]."""
    wrapped = np.pi - (np.pi - angle_rad) % (2.0 * np.pi)
    return np.pi if wrapped == -np.pi else wrapped  # the remainder may round up to 2 pi


@kernel
def inverted(A: Array, inverse: Array) -> bool:
    """Fill in the inverse of a symmetric matrix (3, 3); False where it is not positive."""
    L = np.zeros((3, 3))
    if not cholesky(A, L):
        return False
    columns = np.eye(3)
    forward(L, columns)
    for k in range(3):
        backward(L, columns[:, k])
        inverse[:, k] = columns[:, k]
    return True


@kernel
def times(A: Array, b: Array) -> Array:
    """Return A b, for A (n, 3) and b (3,), shape (n,)."""
    found = np.empty(len(A))
    for i in range(len(A)):
        found[i] = dot(A[i], b)
    return found


@kernel
def dot(a: Array, b: Array) -> float:
    """Return a . b, both (3,)."""
    return float(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])


@kernel
def carried(J: Array, covariance: Array) -> Array:
    """Return J C J^T, for J (n, m) and C (m, m), shape (n, n)."""
    rows, columns = J.shape
    by, spread = np.zeros((rows, columns)), np.zeros((rows, rows))
    for i in range(rows):
        for k in range(columns):
            for m in range(columns):
                by[i, k] += J[i, m] * covariance[m, k]
        for j in range(rows):
            for k in range(columns):
                spread[i, j] += by[i, k] * J[j, k]
    return spread

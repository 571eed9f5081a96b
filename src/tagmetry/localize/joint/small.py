"""Small symmetric systems and rotations, compiled: six unknowns, eight coordinates of a marker."""

import numpy as np
from numba import njit

from tagmetry.geometry.arrays import Array

kernel = njit(cache=True, nogil=True, error_model="numpy")


@kernel
def cholesky(A: Array, L: Array) -> bool:
    """Fill L, lower, with A = L L^T; False where A is not positive."""
    n = len(A)
    for i in range(n):
        for j in range(i + 1):
            total = A[i, j]
            for k in range(j):
                total -= L[i, k] * L[j, k]
            if i == j:
                if not total > 0.0:
                    return False
                L[i, i] = np.sqrt(total)
            else:
                L[i, j] = total / L[j, j]
    return True


@kernel
def forward(L: Array, B: Array) -> None:
    """Replace B, shape (n, k), by L^-1 B."""
    n, count = B.shape
    for i in range(n):
        for j in range(i):
            factor = L[i, j]
            for k in range(count):
                B[i, k] -= factor * B[j, k]
        for k in range(count):
            B[i, k] /= L[i, i]


@kernel
def backward(L: Array, b: Array) -> None:
    """Replace b, shape (n,), by L^-T b."""
    n = len(b)
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            b[i] -= L[j, i] * b[j]
        b[i] /= L[i, i]


@kernel
def times(R: Array, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return R (x, y, z)."""
    return (
        R[0, 0] * x + R[0, 1] * y + R[0, 2] * z,
        R[1, 0] * x + R[1, 1] * y + R[1, 2] * z,
        R[2, 0] * x + R[2, 1] * y + R[2, 2] * z,
    )


@kernel
def back(R: Array, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return R^T (x, y, z)."""
    return (
        R[0, 0] * x + R[1, 0] * y + R[2, 0] * z,
        R[0, 1] * x + R[1, 1] * y + R[2, 1] * z,
        R[0, 2] * x + R[1, 2] * y + R[2, 2] * z,
    )


@kernel
def product(A: Array, B: Array) -> Array:
    """Return A B, both (3, 3)."""
    C = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            C[i, j] = A[i, 0] * B[0, j] + A[i, 1] * B[1, j] + A[i, 2] * B[2, j]
    return C


@kernel
def product_with_transposed(A: Array, B: Array) -> Array:
    """Return A B^T, both (3, 3)."""
    C = np.empty((3, 3))
    for i in range(3):
        for j in range(3):
            C[i, j] = A[i, 0] * B[j, 0] + A[i, 1] * B[j, 1] + A[i, 2] * B[j, 2]
    return C


@kernel
def add_square(rows: Array, P: Array, factor: float) -> None:
    """Add factor rows^T rows to P, rows of shape (n, k), P at least (k, k)."""
    count, width = rows.shape
    for i in range(width):
        for j in range(i + 1):
            total = 0.0
            for n in range(count):
                total += rows[n, i] * rows[n, j]
            P[i, j] += factor * total
            if i != j:
                P[j, i] += factor * total


@kernel
def add(A: Array, total: Array, factor: float) -> None:
    """Add factor A to a matrix of the same shape."""
    for i in range(A.shape[0]):
        for j in range(A.shape[1]):
            total[i, j] += factor * A[i, j]


@kernel
def turn(rotation_vector: Array, R: Array) -> Array:
    """Return Exp(rotation_vector) R by Rodrigues' formula."""
    x, y, z = rotation_vector
    angle2 = x * x + y * y + z * z
    angle = np.sqrt(angle2)
    if angle < 1e-6:
        a, b = 1.0 - angle2 / 6.0, 0.5 - angle2 / 24.0
    else:
        a, b = np.sin(angle) / angle, (1.0 - np.cos(angle)) / angle2
    E = np.empty((3, 3))
    E[0, 0], E[0, 1], E[0, 2] = 1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y
    E[1, 0], E[1, 1], E[1, 2] = b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x
    E[2, 0], E[2, 1], E[2, 2] = b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y)
    return product(E, R)


@kernel
def rotation_vector(R_to: Array, R_from: Array) -> Array:
    """Return the rotation vector of R_to R_from^T, shape (3,), by its quaternion."""
    T = product_with_transposed(R_to, R_from)
    x, y, z, w = T[2, 1] - T[1, 2], T[0, 2] - T[2, 0], T[1, 0] - T[0, 1], 1.0 + np.trace(T)
    if w < 1.0:  # more than 90 degrees: from the largest element of the diagonal
        i = 0
        for k in range(1, 3):
            if T[k, k] > T[i, i]:
                i = k
        j, k = (i + 1) % 3, (i + 2) % 3
        q = np.empty(3)
        q[i] = 1.0 + T[i, i] - T[j, j] - T[k, k]
        q[j], q[k] = T[i, j] + T[j, i], T[i, k] + T[k, i]
        w = T[k, j] - T[j, k]
        x, y, z = q[0], q[1], q[2]
    if w < 0.0:
        x, y, z, w = -x, -y, -z, -w
    length = np.sqrt(x * x + y * y + z * z)
    scale = 2.0 / w if length < 1e-12 * w else 2.0 * np.arctan2(length, w) / length
    return np.array([scale * x, scale * y, scale * z])

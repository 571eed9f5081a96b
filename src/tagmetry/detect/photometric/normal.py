"""Normal equations: sums of products over blocks of pixels, their solution and inverse."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.kernel import Narrow, f32, kernel
from tagmetry.geometry import Array


@kernel
def add_products(room: Narrow, sums: Array, count: int) -> None:
    """Add a block's products to the lower triangle, three rows by three: numbers are reused."""
    for a in range(0, count + 1, 3):
        rows = room[row.RESIDUAL + a * row.BLOCK :]
        for b in range(0, a + 1, 3):
            _add_nine(rows, room[row.RESIDUAL + b * row.BLOCK :], sums[a : a + 3, b : b + 3])


@kernel
def _add_nine(rows: Narrow, columns: Narrow, sums: Array) -> None:
    aa = ab = ac = ba = bb = bc = ca = cb = cc = f32(0)
    for p in range(row.BLOCK):
        a, b, c = rows[p], rows[row.BLOCK + p], rows[2 * row.BLOCK + p]
        k, m, n = columns[p], columns[row.BLOCK + p], columns[2 * row.BLOCK + p]
        aa, ab, ac = aa + a * k, ab + a * m, ac + a * n
        ba, bb, bc = ba + b * k, bb + b * m, bc + b * n
        ca, cb, cc = ca + c * k, cb + c * m, cc + c * n
    sums[0, 0] += aa
    sums[0, 1] += ab
    sums[0, 2] += ac
    sums[1, 0] += ba
    sums[1, 1] += bb
    sums[1, 2] += bc
    sums[2, 0] += ca
    sums[2, 1] += cb
    sums[2, 2] += cc


@kernel
def factor(N: Array, L: Array, scale: Array) -> bool:
    """Write the Cholesky factor of N scaled to a unit diagonal; False where it has none."""
    n = len(scale)
    for a in range(n):
        scale[a] = 1.0 / np.sqrt(max(N[a, a], 1e-300))
    for a in range(n):
        for b in range(a + 1):
            s = N[a, b] * scale[a] * scale[b] + (1e-10 if a == b else 0.0)
            for c in range(b):
                s -= L[a, c] * L[b, c]
            if a > b:
                L[a, b] = s / L[b, b]
            elif s <= 0.0:
                return False
            else:
                L[a, a] = np.sqrt(s)
    return True


@kernel
def _forward(L: Array, x: Array) -> None:
    """Replace x by the solution of L y = x."""
    for a in range(len(x)):
        for c in range(a):
            x[a] -= L[a, c] * x[c]
        x[a] /= L[a, a]


@kernel
def solve(L: Array, scale: Array, g: Array) -> Array:
    """Return the solution of N x = g, N as it was factored."""
    x = g * scale
    _forward(L, x)
    for a in range(len(x) - 1, -1, -1):
        for c in range(a + 1, len(x)):
            x[a] -= L[c, a] * x[c]
        x[a] /= L[a, a]
    return x * scale


@kernel
def inverse_seen(L: Array, scale: Array, J: Array) -> Array:
    """Return J N^-1 J', N as it was factored, J of shape (m, n)."""
    whitened, seen = J * scale, np.zeros((len(J), len(J)))
    for a in range(len(J)):
        _forward(L, whitened[a])
        for b in range(a + 1):
            seen[a, b] = seen[b, a] = (whitened[a] * whitened[b]).sum()
    return seen

"""Normal equations: sums of products over pixels, their solution and inverse."""

import numpy as np

from tagmetry.detect.photometric import block as row
from tagmetry.detect.photometric.kernel import Narrow, kernel
from tagmetry.geometry import Array

_SEEN = 16  # what is asked of an inverse at once: whole vectors


@kernel
def add_products(equations: Narrow, lanes: int, sums: Array, count: int) -> None:
    """Add the first lanes' products to the lower triangle, three rows by three: numbers are reused.

    A last row that is left over is taken alone.

    Row and column 0 are of the residuals.
    """
    for a in range(0, count + 1, 3):
        rows = equations[a * row.LANES :]
        for b in range(0, a + 1, 3):
            columns = equations[b * row.LANES :]
            if a == count:
                _add_three(rows, columns, lanes, sums[a, b : b + 3])
            else:
                _add_nine(rows, columns, lanes, sums[a : a + 3, b : b + 3])


@kernel
def _add_nine(rows: Narrow, columns: Narrow, lanes: int, sums: Array) -> None:
    aa = ab = ac = ba = bb = bc = ca = cb = cc = np.float32(0)
    for p in range(lanes):
        a, b, c = rows[p], rows[row.LANES + p], rows[2 * row.LANES + p]
        k, m, n = columns[p], columns[row.LANES + p], columns[2 * row.LANES + p]
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
def _add_three(last: Narrow, columns: Narrow, lanes: int, sums: Array) -> None:
    ak = am = an = np.float32(0)
    for p in range(lanes):
        a = last[p]
        ak, am = ak + a * columns[p], am + a * columns[row.LANES + p]
        an += a * columns[2 * row.LANES + p]
    sums[0] += ak
    sums[1] += am
    sums[2] += an


@kernel
def factor(sums: Array, L: Array, scale: Array) -> bool:
    """Write the Cholesky factor of N scaled to a unit diagonal; False where it has none.

    Args:
        sums: Of products, as above: N is the lower triangle after the first row and column.
        L: Written: diag(scale) N diag(scale) = L L'.
        scale: Written, as many as there are numbers.
    """
    n = len(scale)
    for a in range(n):
        scale[a] = 1.0 / np.sqrt(max(sums[a + 1, a + 1], 1e-300))
    for a in range(n):
        for b in range(a + 1):
            s = sums[a + 1, b + 1] * scale[a] * scale[b] + (1e-10 if a == b else 0.0)
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
def solve(L: Array, scale: Array, sums: Array) -> Array:
    """Return the solution of N x = g, N as it was factored, g in the first column of the sums."""
    x = np.empty(len(scale))
    for a in range(len(x)):
        s = scale[a] * sums[a + 1, 0]
        for c in range(a):
            s -= L[a, c] * x[c]
        x[a] = s / L[a, a]
    for a in range(len(x) - 1, -1, -1):
        s = x[a] / L[a, a]
        x[a] = s * scale[a]
        for c in range(a):
            x[c] -= L[a, c] * s
    return x


@kernel
def inverse_seen(L: Array, scale: Array, J: Array) -> Array:
    """Return J N^-1 J', N as it was factored, J of shape (m, n), m at most 16."""
    white = _whitened(L, scale, J)
    seen = np.zeros((len(J), _SEEN))
    for k in range(len(J)):
        for a in range(len(white)):
            for j in range(_SEEN):
                seen[k, j] += white[a, k] * white[a, j]
    return seen[:, : len(J)]


@kernel
def _whitened(L: Array, scale: Array, J: Array) -> Array:
    """Return L^-1 diag(scale) J', shape (n, 16)."""
    m, n = J.shape
    white = np.zeros((n, _SEEN))
    for a in range(n):
        for k in range(m):
            white[a, k] = scale[a] * J[k, a]
        for c in range(a):
            for k in range(_SEEN):
                white[a, k] -= L[a, c] * white[c, k]
        for k in range(_SEEN):
            white[a, k] /= L[a, a]
    return white

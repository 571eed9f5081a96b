"""The joint solution's equations at one pose: residuals, derivatives, and the map's error.

State: R, t of T_world_camera; its change (dt, dr) on the left in the world frame. A corner at p in
the world has d = p - t, p_camera = R^T d, q = Q p_camera, residual r = (q_x / q_z, q_y / q_z):

    G = d r / d p_camera = [Q_0 - r_0 Q_2; Q_1 - r_1 Q_2] / q_z,   g = G R^T
    d r / d(dt, dr) = [-g, g x d]                     (rows of g; x the cross product)

A group of markers that is misplaced by (dt_m, dr_m) about its anchor c moves p by
dt_m + dr_m x (p - c), so d r / d(dt_m, dr_m) = [g, (p - c) x g] = A. With S S^T the covariance of
that error it is S z, z ~ N(0, 1). All is whitened by the noise, and with A' = A S the products

    P = [r J A']^T [r J A']                                   shape (13, 13)

add up over the markers of a group; then z is eliminated, M = 1 + A'^T A':

    [chi2 g^T; g H] = [r J]^T [r J] - [r J]^T A' M^-1 A'^T [r J]          shape (7, 7)
"""

import numpy as np

from tagmetry.geometry.arrays import Array, BoolArray
from tagmetry.localize.joint.scene import Scene
from tagmetry.localize.joint.small import add_square, back, cholesky, forward, kernel, times

_NEAREST = 1e-9  # depth of a corner that is just in front, metres


@kernel
def whiteners(scene: Scene, dropped: Array) -> Array:
    """Return lower L with L L^T the noise of each marker, shape (m, 8, 8); NaN where there is none.

    Args:
        scene: What was seen.
        dropped: The corner of each marker that is not to count, -1 for none, shape (m,).
    """
    L = np.zeros(scene.noise.shape)
    for m in range(len(L)):
        noise = scene.noise[m].copy()
        if dropped[m] >= 0:
            for k in range(2 * dropped[m], 2 * dropped[m] + 2):
                noise[k, :] = 0.0
                noise[:, k] = 0.0
                noise[k, k] = 1e12
        if not cholesky(noise, L[m]):
            L[m] = np.nan
    return L


@kernel
def products(scene: Scene, R: Array, t: Array, L: Array) -> tuple[Array, BoolArray]:
    """Return P of each marker, (m, 13, 13), or (m, 7, 7) if the map is exact; who is in front."""
    count, width = len(L), 7 + scene.roots.shape[2]
    P, in_front = np.zeros((count, width, width)), np.zeros(count, dtype=np.bool_)
    rows = np.empty((8, width))
    for m in range(count):
        in_front[m] = _rows(scene, m, R, t, rows)
        if in_front[m]:
            forward(L[m], rows)
            add_square(rows, P[m], 1.0)
    return P, in_front


@kernel
def informations(scene: Scene, R: Array, t: Array) -> tuple[Array, BoolArray]:
    """Return what each marker knows of the pose there, (m, 6, 6), and whether it is in front."""
    P, in_front = products(scene, R, t, whiteners(scene, np.full(len(scene.noise), -1)))
    known = np.zeros((len(P), 6, 6))
    for m in range(len(P)):
        known[m] = marginal(P[m])[1:, 1:]
    return known, in_front


@kernel
def marginal(P: Array) -> Array:
    """Return [chi2 g^T; g H] with the map's error eliminated, shape (7, 7)."""
    system = P[:7, :7].copy()
    if len(P) == 7:
        return system
    M, root = P[7:, 7:].copy(), np.zeros((6, 6))
    for k in range(6):
        M[k, k] += 1.0
    if cholesky(M, root):
        B = P[7:, :7].copy()
        forward(root, B)
        add_square(B, system, -1.0)
    return system


@kernel
def known_system(scene: Scene, R: Array, t: Array) -> Array:
    """Return [chi2 g^T; g H] of what is known beside the markers, shape (7, 7)."""
    system = np.zeros((7, 7))
    for k in range(len(scene.known)):
        v, rows = scene.known[k], np.zeros((3, 7))
        x, y, z = times(R, v[0], v[1], v[2])
        if v[5] > 0.5:
            rows[2, 0], rows[2, 3], rows[2, 4], rows[2, 5] = z + t[2] - v[3], 1.0, y, -x
        else:  # R up_camera - z: as long as the chord of their angle
            rows[0, 0], rows[0, 5], rows[0, 6] = x, z, -y
            rows[1, 0], rows[1, 4], rows[1, 6] = y, -z, x
            rows[2, 0], rows[2, 4], rows[2, 5] = z - 1.0, y, -x
        add_square(rows, system, v[4] * v[4])
    return system


@kernel
def _rows(scene: Scene, m: int, R: Array, t: Array, rows: Array) -> bool:
    """Fill (r, J, A') of one marker, not yet whitened, shape (8, 7 or 13); False if behind."""
    g = scene.group[m]
    for c in range(4):
        p = scene.corners[m, c]
        dx, dy, dz = p[0] - t[0], p[1] - t[1], p[2] - t[2]
        x, y, z = back(R, dx, dy, dz)
        depth = p[9] * x + p[10] * y + p[11] * z
        if not depth > _NEAREST:
            return False
        for k in range(2):
            row, q = rows[2 * c + k], p[3 + 3 * k : 6 + 3 * k]
            r = (q[0] * x + q[1] * y + q[2] * z) / depth
            Gx, Gy, Gz = q[0] - r * p[9], q[1] - r * p[10], q[2] - r * p[11]
            gx, gy, gz = times(R, Gx / depth, Gy / depth, Gz / depth)
            row[0], row[1], row[2], row[3] = r, -gx, -gy, -gz
            row[4], row[5], row[6] = gy * dz - gz * dy, gz * dx - gx * dz, gx * dy - gy * dx
            if len(row) > 7:
                _fill_error(row, scene.anchors[g], scene.roots[g], p, (gx, gy, gz))
    return True


@kernel
def fill_residuals(scene: Scene, m: int, R: Array, t: Array, r: Array) -> bool:
    """Fill the residuals of one marker, not yet whitened, shape (8, 1); False if behind."""
    for c in range(4):
        p = scene.corners[m, c]
        x, y, z = back(R, p[0] - t[0], p[1] - t[1], p[2] - t[2])
        depth = p[9] * x + p[10] * y + p[11] * z
        if not depth > _NEAREST:
            return False
        r[2 * c, 0] = (p[3] * x + p[4] * y + p[5] * z) / depth
        r[2 * c + 1, 0] = (p[6] * x + p[7] * y + p[8] * z) / depth
    return True


@kernel
def _fill_error(
    row: Array, anchor: Array, root: Array, p: Array, g: tuple[float, float, float]
) -> None:
    """Fill A' of one row: [g, (p - c) x g] S."""
    ax, ay, az = p[0] - anchor[0], p[1] - anchor[1], p[2] - anchor[2]
    rx, ry, rz = ay * g[2] - az * g[1], az * g[0] - ax * g[2], ax * g[1] - ay * g[0]
    for j in range(6):
        moved = g[0] * root[0, j] + g[1] * root[1, j] + g[2] * root[2, j]
        row[7 + j] = moved + rx * root[3, j] + ry * root[4, j] + rz * root[5, j]

"""Where each marker alone would have the camera: both of its poses in closed form, compiled.

The same mathematics as `pose.ippe`, which says where it comes from and works on stacks of arrays;
here it is written for one marker at a time, since this is done for every image.
"""

import numpy as np

from tagmetry.geometry.arrays import Array
from tagmetry.localize.joint.scene import Placed
from tagmetry.localize.joint.small import back, kernel, product, product_with_transposed, times


@kernel
def proposals(placed: Placed) -> tuple[Array, Array]:
    """Return R_world_camera (2m, 3, 3) and t (2m, 3), metres; NaN where a marker gives none."""
    count = len(placed.sizes_m)
    Rs, ts = np.full((2 * count, 3, 3), np.nan), np.full((2 * count, 3), np.nan)
    corners, columns, t_view = np.empty((4, 2)), np.empty((2, 3, 2)), np.empty(3)
    for m in range(count):
        T, rays, size_m = placed.poses[m], placed.rays[m], placed.sizes_m[m]
        R_camera_view = _towards_middle(rays)
        if not _see(R_camera_view, rays, corners):
            continue
        _fill_columns(corners, size_m, columns)
        for n in range(2):
            R_view_marker = _completed(columns[n])
            _fill_translation(R_view_marker, corners, size_m, t_view)
            R_camera_marker = product(R_camera_view, R_view_marker)
            R = product_with_transposed(T[:3, :3], R_camera_marker)
            x, y, z = times(R_camera_view, t_view[0], t_view[1], t_view[2])
            x, y, z = times(R, x, y, z)
            Rs[2 * m + n] = R
            ts[2 * m + n, 0] = T[0, 3] - x
            ts[2 * m + n, 1] = T[1, 3] - y
            ts[2 * m + n, 2] = T[2, 3] - z
    return Rs, ts


@kernel
def _towards_middle(rays: Array) -> Array:
    middle = np.zeros(3)
    for c in range(4):
        for k in range(3):
            middle[k] += rays[c, k]
    return _towards(middle[0], middle[1], middle[2])


@kernel
def _towards(x: float, y: float, z: float) -> Array:
    """Return the least rotation that turns the z axis to a direction."""
    length = np.sqrt(x * x + y * y + z * z)
    x, y, z = x / length, y / length, z / length
    bend = 1.0 / max(1.0 + z, 1e-12)
    R = np.empty((3, 3))
    R[0, 0], R[0, 1], R[0, 2] = 1.0 - bend * x * x, -bend * x * y, x
    R[1, 0], R[1, 1], R[1, 2] = R[0, 1], 1.0 - bend * y * y, y
    R[2, 0], R[2, 1], R[2, 2] = -x, -y, z
    return R


@kernel
def _see(R_camera_view: Array, rays: Array, corners: Array) -> bool:
    """Fill the image points (4, 2) of a camera that looks at the marker; False if one is behind."""
    for c in range(4):
        x, y, z = back(R_camera_view, rays[c, 0], rays[c, 1], rays[c, 2])
        if not z > 1e-6:
            return False
        corners[c, 0], corners[c, 1] = x / z, y / z
    return True


@kernel
def _fill_columns(corners: Array, size_m: float, columns: Array) -> None:
    """Fill the first two columns of both rotations, (2, 3, 2) (Collins and Bartoli, section 4)."""
    u, v, slope = _center_and_slope(corners, size_m)
    R = _towards(u, v, 1.0)
    a, b = R[0, 0] - u * R[2, 0], R[0, 1] - u * R[2, 1]
    c, d = R[1, 0] - v * R[2, 0], R[1, 1] - v * R[2, 1]
    A, determinant = np.empty((2, 2)), a * d - b * c
    for j in range(2):
        A[0, j] = (d * slope[0, j] - b * slope[1, j]) / determinant
        A[1, j] = (a * slope[1, j] - c * slope[0, j]) / determinant
    scale = _largest_singular_value(A)
    A /= scale
    rest = -(A[0, 0] * A[0, 1] + A[1, 0] * A[1, 1])  # off the diagonal of 1 - A^T A = b b^T
    b0 = np.sqrt(max(1.0 - A[0, 0] ** 2 - A[1, 0] ** 2, 0.0))
    b1 = np.sqrt(max(1.0 - A[0, 1] ** 2 - A[1, 1] ** 2, 0.0)) * (-1.0 if rest < 0.0 else 1.0)
    for n in range(2):
        sign = 1.0 if n == 0 else -1.0
        for j in range(2):
            x, y, z = times(R, A[0, j], A[1, j], sign * (b0 if j == 0 else b1))
            columns[n, 0, j], columns[n, 1, j], columns[n, 2, j] = x, y, z


@kernel
def _center_and_slope(corners: Array, size_m: float) -> tuple[float, float, Array]:
    """Return the image of the marker's centre and d(image) / d(marker) there, from its homography.

    Reference: P. Heckbert, Fundamentals of Texture Mapping and Image Warping, 1989, for the map
    from the unit square whose corners are those of the marker, clockwise.
    """
    a, b, s = np.empty(2), np.empty(2), np.empty(2)
    for k in range(2):
        a[k], b[k] = corners[1, k] - corners[2, k], corners[3, k] - corners[2, k]
        s[k] = corners[0, k] - corners[1, k] + corners[2, k] - corners[3, k]
    determinant = a[0] * b[1] - a[1] * b[0]
    g = (s[0] * b[1] - s[1] * b[0]) / determinant
    h = (a[0] * s[1] - a[1] * s[0]) / determinant
    depth = 1.0 + 0.5 * (g + h)
    center, slope = np.empty(2), np.empty((2, 2))
    for k in range(2):
        along = corners[1, k] - corners[0, k] + g * corners[1, k]
        down = corners[3, k] - corners[0, k] + h * corners[3, k]
        center[k] = (corners[0, k] + 0.5 * (along + down)) / depth
        slope[k, 0] = (along - g * center[k]) / (depth * size_m)
        slope[k, 1] = (h * center[k] - down) / (depth * size_m)  # the marker's y is up
    return center[0], center[1], slope


@kernel
def _largest_singular_value(A: Array) -> float:
    square_sum = A[0, 0] ** 2 + A[0, 1] ** 2 + A[1, 0] ** 2 + A[1, 1] ** 2
    determinant = A[0, 0] * A[1, 1] - A[0, 1] * A[1, 0]
    spread = np.sqrt(max(square_sum * square_sum - 4.0 * determinant * determinant, 0.0))
    return float(np.sqrt(0.5 * (square_sum + spread)))


@kernel
def _completed(columns: Array) -> Array:
    """Make a rotation from its first two columns, exactly orthonormal."""
    R, length2, along = np.empty((3, 3)), 0.0, 0.0
    for k in range(3):
        length2 += columns[k, 0] ** 2
        along += columns[k, 0] * columns[k, 1]
    rest2 = 0.0
    for k in range(3):
        R[k, 0] = columns[k, 0] / np.sqrt(length2)
        R[k, 1] = columns[k, 1] - along / length2 * columns[k, 0]
        rest2 += R[k, 1] ** 2
    for k in range(3):
        R[k, 1] /= np.sqrt(rest2)
    R[0, 2] = R[1, 0] * R[2, 1] - R[2, 0] * R[1, 1]
    R[1, 2] = R[2, 0] * R[0, 1] - R[0, 0] * R[2, 1]
    R[2, 2] = R[0, 0] * R[1, 1] - R[1, 0] * R[0, 1]
    return R


@kernel
def _fill_translation(R: Array, corners: Array, size_m: float, t: Array) -> None:
    """Fill the translation with the least algebraic error, given the rotation."""
    right, mean, mean_right = np.empty((4, 2)), np.zeros(2), np.zeros(2)
    for c in range(4):
        x_m = 0.5 * size_m if 0 < c < 3 else -0.5 * size_m
        y_m = 0.5 * size_m if c < 2 else -0.5 * size_m
        depth = x_m * R[2, 0] + y_m * R[2, 1]
        for k in range(2):
            right[c, k] = corners[c, k] * depth - x_m * R[k, 0] - y_m * R[k, 1]
            mean[k] += 0.25 * corners[c, k]
            mean_right[k] += 0.25 * right[c, k]
    above, below = 0.0, 0.0
    for c in range(4):
        for k in range(2):
            above -= (corners[c, k] - mean[k]) * right[c, k]
            below += (corners[c, k] - mean[k]) ** 2
    t[2] = above / below
    t[0], t[1] = mean_right[0] + mean[0] * t[2], mean_right[1] + mean[1] * t[2]

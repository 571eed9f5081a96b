"""The two poses of a square marker in closed form: infinitesimal plane-based pose estimation.

At the marker's centre the homography's derivative fixes the first two columns of the rotation up to
one sign: the marker may lean towards the viewer or away by the same angle. Both answers are given,
because noise decides which of them fits better when the marker is small or nearly frontal.

Frames: `p_camera = R_camera_marker @ p_marker + t`, corners clockwise from the top left.

Reference: T. Collins and A. Bartoli, Infinitesimal Plane-Based Pose Estimation, IJCV 2014. Written
for stacks of markers, and with every root taken of a number held at zero or above: rounding makes
it negative for views centred on the principal row, where OpenCV's float32 version returns NaN.
"""

import numpy as np

from tagmetry.geometry import Array, square_to_quad

_UNIT_SQUARE_FROM_MARKER = np.array([[1.0, 0.0, 0.5], [0.0, -1.0, 0.5], [0.0, 0.0, 1.0]])


def ippe(rays: Array, p_marker: Array) -> tuple[Array, Array]:
    """Return both poses of each marker.

    Args:
        rays: Viewing rays of the corners in the camera frame, shape (n, 4, 3), any length.
        p_marker: The corners in the marker's frame, shape (n, 4, 3), metres, z = 0.

    Returns:
        R_camera_marker, shape (n, 2, 3, 3), and translations, shape (n, 2, 3), metres. What a
        degenerate quadrilateral gives may be anything, also not finite.
    """
    middle = rays.mean(axis=1)
    R_camera_view = _towards(middle / np.linalg.norm(middle, axis=1, keepdims=True))
    view_rays = rays @ R_camera_view
    corners = view_rays[..., :2] / view_rays[..., 2:]
    R_view_marker, t_view = _poses_in_view(corners, p_marker)
    R = R_camera_view[:, None] @ R_view_marker
    return R, t_view @ np.swapaxes(R_camera_view, 1, 2)


def _poses_in_view(corners: Array, p_marker: Array) -> tuple[Array, Array]:
    """Solve for a camera that looks at the marker; corners are image points (x / z, y / z)."""
    size_m = p_marker[:, 1, 0] - p_marker[:, 0, 0]
    H = square_to_quad(corners) @ _UNIT_SQUARE_FROM_MARKER
    H = H / H[:, 2:, 2:]
    center = H[:, :2, 2]
    slope = H[:, :2, :2] - center[:, :, None] * H[:, 2:, :2]  # d(image) / d(marker) at the centre
    R = _rotations(center, slope / size_m[:, None, None])
    return R, _translations(R, corners, p_marker)


def _rotations(center: Array, slope: Array) -> Array:
    """Solve (I | -center) R[:, :2] ~ slope for both rotations (Collins and Bartoli, section 4)."""
    ray = np.concatenate([center, np.ones_like(center[:, :1])], axis=1)
    R_view_center = _towards(ray / np.linalg.norm(ray, axis=1, keepdims=True))
    flat = R_view_center[:, :2, :2] - center[:, :, None] * R_view_center[:, 2:, :2]
    A = np.asarray(np.linalg.solve(flat, slope), dtype=np.float64)
    upper = A / _largest_singular_value(A)[:, None, None]
    rest = np.eye(2) - np.swapaxes(upper, 1, 2) @ upper  # = b b^T
    b = np.sqrt(np.maximum(np.stack([rest[:, 0, 0], rest[:, 1, 1]], axis=1), 0.0))
    b[:, 1] *= np.where(rest[:, 0, 1] < 0, -1.0, 1.0)
    both = np.stack([b, -b], axis=1)
    first_columns = np.concatenate(
        [np.broadcast_to(upper[:, None], (len(upper), 2, 2, 2)), both[:, :, None, :]], axis=2
    )
    return R_view_center[:, None] @ _completed(first_columns)


def _towards(direction: Array) -> Array:
    """Return the least rotations that turn the z axis to unit vectors (n, 3), shape (n, 3, 3)."""
    x, y, z = direction.T
    bend = 1 / (1 + z)
    xx, xy, yy = 1 - bend * x * x, -bend * x * y, 1 - bend * y * y
    rows = [[xx, xy, x], [xy, yy, y], [-x, -y, z]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def _largest_singular_value(A: Array) -> Array:
    square_sum = (A**2).sum(axis=(1, 2))
    determinant = A[:, 0, 0] * A[:, 1, 1] - A[:, 0, 1] * A[:, 1, 0]
    spread = np.sqrt(np.maximum(square_sum**2 - 4 * determinant**2, 0.0))
    return np.asarray(np.sqrt((square_sum + spread) / 2))


def _completed(first_columns: Array) -> Array:
    """Make rotations from their first two columns, shape (..., 3, 2), exactly orthonormal."""
    x = first_columns[..., 0]
    x = x / np.linalg.norm(x, axis=-1, keepdims=True)
    y = first_columns[..., 1]
    y = y - (x * y).sum(axis=-1, keepdims=True) * x
    y = y / np.linalg.norm(y, axis=-1, keepdims=True)
    return np.stack([x, y, np.cross(x, y)], axis=-1)


def _translations(R: Array, corners: Array, p_marker: Array) -> Array:
    """Return the translations with the least algebraic error, given the rotations.

    Each corner (u, v) says: t_x - u t_z = u q_z - q_x and t_y - v t_z = v q_z - q_y, q = R p.
    """
    q = p_marker[:, None] @ np.swapaxes(R, -1, -2)
    uv = corners[:, None]
    right = uv * q[..., 2:] - q[..., :2]
    mean_uv, mean_right = uv.mean(axis=-2), right.mean(axis=-2)
    spread = uv - mean_uv[..., None, :]
    depth = -(spread * right).sum(axis=(-1, -2)) / (spread**2).sum(axis=(-1, -2))
    across = mean_right + mean_uv * depth[..., None]
    return np.concatenate([across, depth[..., None]], axis=-1)

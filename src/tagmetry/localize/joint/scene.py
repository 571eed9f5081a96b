"""What the joint solution works on: plain arrays of everything that was seen and is known.

A corner's residual is taken on the plane that touches its viewing ray u at distance one: with an
orthonormal frame Q = [a b u]^T and q = Q p_camera it is (q_x / q_z, q_y / q_z), which is free of
the lens and zero where the point lies on the ray. The corners' covariance is carried there by the
lens's derivative, so a pose is as likely there as in pixels, to first order in the noise.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry.arrays import Array, IntArray
from tagmetry.localize.joint.rays import rays_and_jacobians
from tagmetry.localize.knowledge import Knowledge, known_rows
from tagmetry.localize.marker_map import MapMarker
from tagmetry.localize.seen import SeenMarker


class Scene(NamedTuple):
    """m markers in g groups that share the map's error, and what is known beside them.

    Few arrays, since the compiled code pays for each of them at every call.

    Attributes:
        corners: Place in the world and Q of every corner, shape (m, 4, 12): p_world (3), metres,
            and the rows of Q (9).
        noise: Covariance of a marker's eight tangent coordinates, shape (m, 8, 8).
        group: Which group each marker belongs to, shape (m,).
        anchors: Where the groups' errors turn about, shape (g, 3), metres.
        roots: S with S S^T the covariance of a group's error, shape (g, 6, 6); (g, 6, 0) where the
            map is exact.
        known: What is known beside the markers, shape (n, 6): a vector of the camera frame (3), a
            height (m), 1 / deviation, and 1 for a point at that height, 0 for a direction of up.
    """

    corners: Array
    noise: Array
    group: IntArray
    anchors: Array
    roots: Array
    known: Array


class Placed(NamedTuple):
    """Where m markers stand and from where each alone would be seen.

    Attributes:
        poses: T_world_marker, shape (m, 4, 4), metres.
        rays: Unit viewing rays of the corners, shape (m, 4, 3).
        sizes_m: Shape (m,).
    """

    poses: Array
    rays: Array
    sizes_m: Array


def scene_of(
    seen: Sequence[SeenMarker], camera: Camera, known: Knowledge
) -> tuple[Scene, Placed, IntArray]:
    """Return the arrays of the markers whose corners the lens can show, and which those are.

    Returns:
        The scene of m markers, their places, and their numbers among `seen`, shape (m,).
    """
    pixels = np.array([one.detection.corners_px for one in seen], dtype=np.float64)
    rays, by_direction = rays_and_jacobians(camera, pixels)
    shown = np.flatnonzero(np.isfinite(rays).all(axis=(1, 2)))
    rays, seen = rays[shown], [seen[int(n)] for n in shown]
    markers = [one.marker for one in seen]
    noise_px2 = np.array([one.detection.corners_cov_px2 for one in seen], dtype=np.float64)
    frames = _frames(rays)
    group, first = _groups(markers)
    p_world = np.array([one.p_world for one in markers]).reshape(-1, 4, 3)
    scene = Scene(
        np.concatenate([p_world, frames.reshape(-1, 4, 9)], axis=2),
        _on_tangents(noise_px2.reshape(-1, 8, 8), frames, by_direction[shown]),
        group,
        np.array([one.matrix[:3, 3] for one in first]).reshape(-1, 3),
        _roots(first),
        known_rows(known),
    )
    poses = np.array([one.matrix for one in markers]).reshape(-1, 4, 4)
    return scene, Placed(poses, rays, np.array([one.size_m for one in markers])), shown


def _roots(first: Sequence[MapMarker]) -> Array:
    if all(one.is_exact for one in first):
        return np.zeros((len(first), 6, 0))
    return np.array([one.covariance_root for one in first]).reshape(-1, 6, 6)


def _groups(markers: Sequence[MapMarker]) -> tuple[IntArray, list[MapMarker]]:
    """Return each marker's group and the first marker of every group."""
    names: dict[object, int] = {}
    first: list[MapMarker] = []
    group = np.empty(len(markers), dtype=np.int64)
    for n, marker in enumerate(markers):
        name = marker.key if marker.body is None else marker.body
        if name not in names:
            names[name] = len(first)
            first.append(marker)
        group[n] = names[name]
    return group, first


def _frames(rays: Array) -> Array:
    """Return orthonormal frames whose third row is the ray, shape (..., 3, 3).

    The least rotation that takes the z axis to the ray, for rays up to the half turn.
    """
    x, y, z = np.moveaxis(rays, -1, 0)
    bend = 1.0 / np.maximum(1.0 + z, 1e-12)
    frames = np.empty((*rays.shape, 3))
    frames[..., 0, 0], frames[..., 0, 1] = 1.0 - bend * x * x, -bend * x * y
    frames[..., 1, 0], frames[..., 1, 1] = frames[..., 0, 1], 1.0 - bend * y * y
    frames[..., 0, 2], frames[..., 1, 2] = -x, -y
    frames[..., 2, :] = rays
    return frames


def _on_tangents(noise_px2: Array, frames: Array, by_direction: Array) -> Array:
    """Carry covariances of pixels (m, 8, 8) to the tangent planes."""
    by_tangent = by_direction @ np.swapaxes(frames[..., :2, :], -1, -2)  # d(pixel) / d(tangent)
    (a, b), (c, d) = np.moveaxis(by_tangent, (-2, -1), (0, 1))
    inverse = np.stack([d, -b, -c, a], axis=-1) / (a * d - b * c)[..., None]
    blocks = np.zeros((len(frames), 4, 2, 4, 2))
    blocks[:, range(4), :, range(4)] = np.moveaxis(inverse.reshape(-1, 4, 2, 2), 1, 0)
    carry = blocks.reshape(-1, 8, 8)
    return np.asarray(carry @ noise_px2 @ np.swapaxes(carry, 1, 2))

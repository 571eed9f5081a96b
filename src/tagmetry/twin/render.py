"""A simple renderer: printed markers in front of a plain background, seen by a camera.

Every pixel is the mean of many viewing rays; each ray meets the markers' planes and takes the
colour of the cell that it hits, the nearest plane winning. Blur and noise follow. A marker is drawn
with a white quiet zone around it.

Frames: `p_camera = T_camera_marker @ p_marker`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import BoolArray, GreyPixels
from tagmetry.markers import MountedMarker, family, marker_corners_m

_EDGE_PX = 2  # pixels around a marker's outline that are rendered with it


@dataclass(frozen=True)
class Look:
    """How the rendered picture looks.

    Attributes:
        black: Grey value of ink, 0 to 255.
        white: Grey value of paper.
        background: Grey value behind the markers.
        blur_px: Standard deviation of a Gaussian point spread. It acts on whole pixels: an edge's
            profile keeps to the Gaussian's integral within 1 % from 1 px on, within 4 % at 0.6.
        noise: Standard deviation of the noise, grey values.
        rays_per_side: Rays along a pixel's side; their square is the number per pixel.
        quiet_cells: Width of the white zone around a marker.
    """

    black: float = 30.0
    white: float = 210.0
    background: float = 120.0
    blur_px: float = 0.6
    noise: float = 1.0
    rays_per_side: int = 6
    quiet_cells: float = 1.0


def render(
    markers: Sequence[MountedMarker],
    T_camera_body: RigidTransform,
    camera: Camera,
    rng: np.random.Generator,
    look: Look | None = None,
) -> GreyPixels:
    """Return a grey picture of markers on a body, shape (height, width), uint8.

    Args:
        markers: Markers at their places on the body.
        T_camera_body: Where the body is.
        camera: Intrinsics of the picture.
        rng: Where the noise comes from.
        look: Colours, blur and noise.
    """
    look = look or Look()
    grey = np.full((camera.height_px, camera.width_px), look.background, dtype=np.float64)
    by_distance = sorted(markers, key=lambda m: -_distance_m(T_camera_body * m.T_body_marker))
    for marker in by_distance:
        _draw(grey, marker, T_camera_body * marker.T_body_marker, camera, look)
    if look.blur_px > 0:
        grey = gaussian_filter(grey, look.blur_px, mode="nearest")
    grey = grey + rng.normal(0.0, look.noise, grey.shape) if look.noise > 0 else grey
    return np.asarray(np.clip(np.rint(grey), 0, 255), dtype=np.uint8)


def _draw(
    grey: Array, marker: MountedMarker, T_camera_marker: RigidTransform, camera: Camera, look: Look
) -> None:
    """Paint one marker over what is behind it."""
    picture = family(marker.family).picture(marker.id)
    layout = family(marker.family).layout
    cell_m = marker.size_m / layout.side_cells
    half_m = marker.size_m / 2 + (layout.margin_cells + look.quiet_cells) * cell_m
    outline = T_camera_marker.apply(marker_corners_m(2 * half_m))
    box = _box(camera.project(outline), camera)
    if box is None or T_camera_marker.rotation.as_matrix()[:, 2] @ outline.mean(axis=0) >= 0:
        return
    left, top, right, bottom = box
    share, ink = np.zeros((2, bottom - top, right - left))
    for p_marker in _on_marker(box, T_camera_marker, camera, look.rays_per_side**2):
        inside = (np.abs(p_marker) <= half_m).all(axis=-1)
        white = _cells(p_marker, picture, layout.margin_cells, cell_m, marker.size_m)
        share += inside
        ink += np.where(inside, np.where(white, look.white, look.black), 0.0)
    share, ink = share / look.rays_per_side**2, ink / look.rays_per_side**2
    window = grey[top:bottom, left:right]
    window[:] = ink + (1 - share) * window


def _box(outline_px: Array, camera: Camera) -> tuple[int, int, int, int] | None:
    """Return the pixels (left, top, right, bottom) that can show a marker, None if none do."""
    if not np.isfinite(outline_px).all():
        return None
    low = np.floor(outline_px.min(axis=0)).astype(int) - _EDGE_PX
    high = np.ceil(outline_px.max(axis=0)).astype(int) + _EDGE_PX + 1
    left, top = np.maximum(low, 0)
    right, bottom = np.minimum(high, camera.size_px)
    return (left, top, right, bottom) if left < right and top < bottom else None


def _on_marker(
    box: tuple[int, int, int, int], T_camera_marker: RigidTransform, camera: Camera, count: int
) -> Iterator[Array]:
    """Give where each of `count` rays per pixel meets the marker's plane, (height, width, 2).

    NaN where it does not. The lens is asked at the pixels' corners; between them directions are
    linear to 1e-4 px.
    """
    left, top, right, bottom = box
    grid = np.meshgrid(np.arange(left, right + 1) - 0.5, np.arange(top, bottom + 1) - 0.5)
    R_camera_marker = T_camera_marker.rotation.as_matrix()
    rays = camera.unproject(np.stack(grid, axis=-1)) @ R_camera_marker
    eye = -T_camera_marker.translation @ R_camera_marker
    for x, y in zip(*_within_pixel(count), strict=True):
        upper = (1 - x) * rays[:-1, :-1] + x * rays[:-1, 1:]
        lower = (1 - x) * rays[1:, :-1] + x * rays[1:, 1:]
        ray = (1 - y) * upper + y * lower
        depth = np.where(ray[..., 2:] < 0, ray[..., 2:], np.nan)
        yield eye[:2] - ray[..., :2] * (eye[2] / depth)


def _within_pixel(count: int) -> tuple[Array, Array]:
    """Return where rays pierce a pixel, 0 to 1, each of x and y taking `count` values.

    A square grid would place edges along the pixels' rows only to 1 / sqrt(count) px.
    """
    even = (np.arange(count) + 0.5) / count
    return even, even[np.argsort(np.arange(count) * 0.6180339887498949 % 1)]


def _cells(
    p_marker: Array, picture: BoolArray, margin: int, cell_m: float, size_m: float
) -> BoolArray:
    """Return which rays hit white: a white cell, or the paper around the cells."""
    with np.errstate(invalid="ignore"):
        column = np.floor((p_marker[..., 0] + size_m / 2) / cell_m) + margin
        row = np.floor((size_m / 2 - p_marker[..., 1]) / cell_m) + margin
        outside = ~((column >= 0) & (row >= 0) & (column < len(picture)) & (row < len(picture)))
    column, row = (np.where(outside, 0, index).astype(int) for index in (column, row))
    return np.asarray(outside | picture[row, column])


def _distance_m(T_camera_marker: RigidTransform) -> float:
    return float(np.linalg.norm(T_camera_marker.translation))

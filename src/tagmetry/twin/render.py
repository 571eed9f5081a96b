"""Exact pictures of printed markers, by the twin's own rays.

Every pixel is the exact mean of what its footprint shows (`coverage`); the point spread is applied
on a grid fine enough to hold it, before pixels are formed; noise and rounding follow. Sheets are
painted from far to near, each over what it covers.

Frames: `p_camera = T_camera_body.apply(p_body)`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.arrays import FloatImage, GreyPixels
from tagmetry.markers import MountedMarker
from tagmetry.twin.coverage import footprint_means
from tagmetry.twin.rays import Rays
from tagmetry.twin.sheet import Layer, Sheet, marker_sheet

_HELD_BLUR = 1.2  # standard deviation, in points of the fine grid, that it holds without aliasing
_STEP_VARIANCE = (
    1 / 12
)  # an edge within a fine pixel becomes two steps: this much wider, on average
_FINEST = 4
_MARGIN_PX = 2


@dataclass(frozen=True)
class Look:
    """How the rendered picture looks.

    Attributes:
        black: Grey value of ink, 0 to 255.
        white: Grey value of paper.
        background: Grey value behind the markers.
        blur_px: Standard deviation of a Gaussian point spread, besides the pixel's own area.
        noise: Standard deviation of the noise, grey values.
        quiet_cells: Width of the white zone around a marker.
    """

    black: float = 30.0
    white: float = 210.0
    background: float = 120.0
    blur_px: float = 0.6
    noise: float = 1.0
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
    fine = _fine_scale(look.blur_px)
    grey = np.full((camera.height_px * fine, camera.width_px * fine), look.background, np.float32)
    sheets = [marker_sheet(marker, look.quiet_cells) for marker in markers]
    for sheet in sorted(sheets, key=lambda one: -_distance_m(T_camera_body * one.T_body_sheet)):
        _paint(grey, sheet, T_camera_body * sheet.T_body_sheet, camera, fine, look)
    return _developed(grey, fine, rng, look)


def _fine_scale(blur_px: float) -> int:
    """Return how many points of the fine grid make a pixel's side; without blur, one is exact."""
    return 1 if blur_px == 0 else min(_FINEST, int(np.ceil(_HELD_BLUR / blur_px)))


def _distance_m(T_camera_sheet: RigidTransform) -> float:
    return float(np.linalg.norm(T_camera_sheet.translation))


def _paint(
    grey: FloatImage,
    sheet: Sheet,
    T_camera_sheet: RigidTransform,
    camera: Camera,
    fine: int,
    look: Look,
) -> None:
    """Paint one sheet, layer by layer, over what is behind it."""
    box = _box(sheet, T_camera_sheet, camera)
    if box is None:
        return
    left, top, right, bottom = (fine * edge for edge in box)
    u = np.arange(left, right + 1) / fine - 0.5  # the corners of the fine pixels
    v = np.arange(top, bottom + 1) / fine - 0.5
    x_m, y_m = _on_sheet(Rays(camera).look(*np.meshgrid(u, v)), T_camera_sheet)
    window = grey[top:bottom, left:right]
    for layer in sheet.layers:
        colour, share = footprint_means(*_in_cells(x_m, y_m, layer), layer.cells)
        window *= 1 - share
        window += look.black * share + (look.white - look.black) * colour


def _box(
    sheet: Sheet, T_camera_sheet: RigidTransform, camera: Camera
) -> tuple[int, int, int, int] | None:
    """Return the pixels (left, top, right, bottom) that can show a sheet; None if none do."""
    outward = T_camera_sheet.rotation.as_matrix()[:, 2]
    if outward @ T_camera_sheet.translation >= 0:  # its back is turned
        return None
    seen = Rays(camera).see(T_camera_sheet.apply(sheet.rim_m(points_per_side=8)))
    if not np.isfinite(seen).all():
        return None
    low = np.floor(seen.min(axis=0)).astype(int) - _MARGIN_PX
    high = np.ceil(seen.max(axis=0)).astype(int) + _MARGIN_PX + 1
    left, top = (int(edge) for edge in np.maximum(low, 0))
    right, bottom = (int(edge) for edge in np.minimum(high, camera.size_px))
    return (left, top, right, bottom) if left < right and top < bottom else None


def _on_sheet(rays: Array, T_camera_sheet: RigidTransform) -> tuple[Array, Array]:
    """Return where viewing rays (..., 3) meet the sheet, x and y in its frame, NaN where behind."""
    R_camera_sheet = T_camera_sheet.rotation.as_matrix()
    camera_in_sheet = -T_camera_sheet.translation @ R_camera_sheet
    along = rays @ R_camera_sheet
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = -camera_in_sheet[2] / along[..., 2]
        reach[~(reach > 0)] = np.nan
    return camera_in_sheet[0] + reach * along[..., 0], camera_in_sheet[1] + reach * along[..., 1]


def _in_cells(x_m: Array, y_m: Array, layer: Layer) -> tuple[Array, Array]:
    """Return places on a sheet in a layer's cells, x right and y down from its top left corner."""
    rows, columns = layer.cells.shape
    return x_m / layer.cell_m + columns / 2, rows / 2 - y_m / layer.cell_m


def _developed(grey: FloatImage, fine: int, rng: np.random.Generator, look: Look) -> GreyPixels:
    """Blur on the fine grid, form pixels, add noise, round."""
    if look.blur_px > 0:
        spread = np.sqrt((fine * look.blur_px) ** 2 - _STEP_VARIANCE)
        grey = np.asarray(cv2.GaussianBlur(grey, (0, 0), spread), np.float32)
    size_px = (grey.shape[1] // fine, grey.shape[0] // fine)
    pixels = np.asarray(cv2.resize(grey, size_px, interpolation=cv2.INTER_AREA), dtype=np.float64)
    if look.noise > 0:
        pixels = pixels + rng.normal(0.0, look.noise, pixels.shape)
    return np.asarray(np.clip(np.rint(pixels), 0, 255), dtype=np.uint8)

"""How much of a marker a picture shows.

    fraction = sum over pixels of (area on the marker that the pixel sees) (share of it not hidden)

by the marker's area. The area is exact: a pixel's four corner rays meet the marker's plane in a
quadrilateral, which is cut by the marker's square. What hides it are the sheets painted later; of
a pixel that several edges cross, their shares are taken to be independent.
"""

from typing import NamedTuple

import numpy as np

from tagmetry.geometry import Array, RigidTransform
from tagmetry.markers import MountedMarker
from tagmetry.twin.rendering.coverage import footprint_means
from tagmetry.twin.rendering.grid import Grid
from tagmetry.twin.rendering.seen import SeenSheet, covered_box
from tagmetry.twin.rendering.view import View
from tagmetry.twin.scenes.sheet import Sheet
from tagmetry.twin.scenes.thing import Thing

_SOLID = np.ones((1, 1))
_POINTS_ALONG = 256  # of a marker's side, so that edges in a pixel matter less
_FINEST = 8
_ROWS_LOOKED_AT = 9
_FLAT = 1e-9


class Window(NamedTuple):
    """The part of a sensor that the picture shows, pixels; a pixel reaches from -1/2 to 1/2."""

    left: float
    top: float
    right: float
    bottom: float


def visible_fraction(
    marker: MountedMarker, thing: Thing, seen: list[SeenSheet], view: View, window: Window
) -> float:
    """Return the share of a marker's black square that a picture shows, 0 to 1.

    Args:
        marker: One of the thing's.
        thing: What the marker is on.
        seen: The sheets that the camera sees, what is painted first first, within the image.
        view: Who sees it, at the middle of the exposure.
        window: What the picture shows of the sensor.
    """
    own = _number_of(_sheet_under(marker, thing), seen)
    if own is None:
        return 0.0
    rows_px = np.linspace(-0.5, view.camera.height_px - 0.5, _ROWS_LOOKED_AT)
    Ts_camera_marker = view.Ts_camera_thing(thing.path, rows_px) * marker.T_body_marker
    half_m = (marker.size_m / 2, marker.size_m / 2)
    box = seen[own].box & covered_box(half_m, (0.0, 0.0), Ts_camera_marker, view.camera)
    if not box:
        return 0.0
    side_px = max(box.right - box.left, box.bottom - box.top)
    fine = int(np.clip(np.ceil(_POINTS_ALONG / side_px), 1, _FINEST))
    grid = Grid(view.camera, box, fine)
    shown = _areas(marker, thing, grid, view) * _within(window, grid)
    for nearer in seen[own + 1 :]:
        if part := nearer.box & box:
            piece = shown[part.inside(box, fine)]
            piece *= 1 - _cover(nearer, Grid(view.camera, part, fine), view)
    return float(np.clip(shown.sum(), 0.0, 1.0))


def _areas(marker: MountedMarker, thing: Thing, grid: Grid, view: View) -> Array:
    """Return how much of the marker every point of a grid sees, as a share of its area."""
    Ts_camera_marker = view.Ts_camera_thing(thing.path, grid.rows_px) * marker.T_body_marker
    x, y = (hit / marker.size_m for hit in grid.hits_m(grid.box, Ts_camera_marker))
    _, share = footprint_means(x + 0.5, 0.5 - y, _SOLID)
    return np.where(share > 0, share * np.nan_to_num(_footprints(x, y)), 0.0)


def _footprints(x: Array, y: Array) -> Array:
    """Return the areas of the quadrilaterals that points see, from where their corners look."""
    across = (x[1:, 1:] - x[:-1, :-1]) * (y[1:, :-1] - y[:-1, 1:])
    back = (x[1:, :-1] - x[:-1, 1:]) * (y[1:, 1:] - y[:-1, :-1])
    return np.asarray(np.abs(across - back) / 2)


def _within(window: Window, grid: Grid) -> Array:
    """Return the share of every point of a grid that lies in a window."""
    rows, columns = grid.shape
    v_px = grid.box.top - 0.5 + np.arange(rows + 1) / grid.fine
    u_px = grid.box.left - 0.5 + np.arange(columns + 1) / grid.fine
    down = np.diff(np.clip(v_px, window.top, window.bottom))
    across = np.diff(np.clip(u_px, window.left, window.right))
    return np.asarray(np.outer(down, across) * grid.fine**2)


def _cover(one: SeenSheet, grid: Grid, view: View) -> Array:
    """Return the share of every point of a grid that a sheet covers."""
    sheet = one.sheet
    Ts_camera_sheet = view.Ts_camera_thing(one.thing.path, grid.rows_px) * sheet.T_thing_sheet
    x_m, y_m = grid.hits_m(grid.box, Ts_camera_sheet)
    return footprint_means(x_m / sheet.width_m + 0.5, 0.5 - y_m / sheet.height_m, _SOLID)[1]


def _number_of(sheet: Sheet | None, seen: list[SeenSheet]) -> int | None:
    """Return the place of a sheet among those that are seen."""
    return next((i for i, one in enumerate(seen) if one.sheet is sheet), None)


def _sheet_under(marker: MountedMarker, thing: Thing) -> Sheet | None:
    """Return the sheet that a marker is printed on, the uppermost of its plane."""
    on = [sheet for sheet in thing.sheets if _lies_on(marker.T_body_marker, sheet)]
    return on[-1] if on else None


def _lies_on(T_thing_marker: RigidTransform, sheet: Sheet) -> bool:
    T_sheet_marker = sheet.T_thing_sheet.inv() * T_thing_marker
    x_m, y_m, z_m = np.abs(T_sheet_marker.translation)
    facing = T_sheet_marker.rotation.as_matrix()[2, 2] > 1 - _FLAT
    within = x_m <= sheet.width_m / 2 and y_m <= sheet.height_m / 2 and z_m <= _FLAT
    return bool(facing and within)

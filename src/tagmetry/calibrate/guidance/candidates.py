"""Where the board could be held next: places over the image, near and far, tilted to all sides."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.bundle import Bundle
from tagmetry.calibrate.guidance.knowledge import Knowledge, bundle_at
from tagmetry.calibrate.quality.places import Place, poses_at
from tagmetry.calibrate.sightings import Sightings
from tagmetry.calibrate.view import BoardView
from tagmetry.camera import Camera
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import BoolArray
from tagmetry.markers import Board

_COLUMNS, _ROWS = 9, 7
_FILLS = (0.35, 0.55, 0.8)  # of the image's width or height, whichever the board fills first
_TILT_SHARES = (0.0, 0.5, 1.0)
_DIRECTIONS_DEG = (0.0, 90.0, 180.0, 270.0)
_LEAST_SEEN = 0.5  # of a board of markers; a board without must be seen whole


@dataclass(frozen=True)
class HoldingLimits:
    """How the board can be held.

    Attributes:
        nearest_m: From the camera to the board's centre, at least.
        farthest_m: At most.
        largest_tilt_deg: Between the board's normal and the line to the camera.
        margin_px: Corners keep this far from the image's edge.
        apart_share: Least distance from views taken, root mean square over the corners, as a share
            of the image's diagonal: so far that a hand that misses a little still shows a new view.
    """

    nearest_m: float = 0.0
    farthest_m: float = np.inf
    largest_tilt_deg: float = 40.0
    margin_px: float = 8.0
    apart_share: float = 0.06

    def __post_init__(self) -> None:
        if not 0 <= self.nearest_m < self.farthest_m:
            raise InputError(
                f"expected nearest_m below farthest_m, got {self.nearest_m} and {self.farthest_m}"
            )
        if not 0 < self.largest_tilt_deg < 80:
            raise InputError(
                f"expected largest_tilt_deg between 0 and 80, got {self.largest_tilt_deg}"
            )


@dataclass(frozen=True, eq=False)
class Candidates:
    """Places at which the camera would see the board.

    Attributes:
        places: n of them.
        bundle: The camera and the board's pose at each.
        seen: Which corners would be seen; with no places to speak of.
    """

    places: tuple[Place, ...]
    bundle: Bundle
    seen: Sightings


def candidates(
    known: Knowledge, board: Board, limits: HoldingLimits, taken: Sequence[BoardView] = ()
) -> Candidates:
    """Return places at which enough of the board would be in the picture.

    Args:
        known: What is known of the camera.
        board: The board.
        limits: How it can be held.
        taken: Views that are not to be repeated while there are other places.

    Raises:
        InputError: There is none within the limits.
    """
    camera, p_board = known.camera, board.corners_m
    places = _grid(camera, distances_m(camera, board, limits), limits.largest_tilt_deg)
    Ts = poses_at(camera, places)
    bundle = bundle_at(camera, Ts.rotation.as_matrix(), np.asarray(Ts.translation), p_board)
    pixels = bundle.predict()
    inside = _inside(camera, pixels, limits.margin_px)
    least = _LEAST_SEEN if board.markers() else 1.0
    new = _farther_than(limits.apart_share * np.hypot(*camera.size_px), pixels, taken)
    shown = inside.mean(axis=1) >= least
    enough = np.flatnonzero(shown & new if (shown & new).any() else shown)
    if not enough.size:
        raise InputError(
            "no place within the limits shows enough of the board; allow it to be farther away"
        )
    shown = inside[enough]
    whiteners = shown[..., None, None] * np.eye(2) / known.corner_sd_px
    points, nowhere = np.arange(len(p_board)), np.zeros((*shown.shape, 2))
    seen = Sightings(camera.size_px, points, p_board, nowhere, whiteners)
    return Candidates(tuple(places[i] for i in enough), bundle.only(enough), seen)


def distances_m(camera: Camera, board: Board, limits: HoldingLimits) -> tuple[float, ...]:
    """Return distances at which the board fills shares of the picture, within the limits."""
    sizes = np.array([board.width_m, board.height_m]) * camera.focal_px
    full = float((sizes / camera.size_px).max())
    within = [float(np.clip(full / fill, limits.nearest_m, limits.farthest_m)) for fill in _FILLS]
    return tuple(dict.fromkeys(within))


def _grid(camera: Camera, distances: Sequence[float], largest_tilt_deg: float) -> list[Place]:
    u = np.linspace(0.1, 0.9, _COLUMNS) * (camera.width_px - 1)
    v = np.linspace(0.1, 0.9, _ROWS) * (camera.height_px - 1)
    pixels = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 2)
    shown = pixels[np.isfinite(camera.unproject(pixels)).all(axis=1)]
    tilts = [(0.0, 0.0)]
    tilts += [(s * largest_tilt_deg, d) for s in _TILT_SHARES[1:] for d in _DIRECTIONS_DEG]
    return [
        Place((float(x), float(y)), distance, tilt, direction)
        for distance in distances
        for tilt, direction in tilts
        for x, y in shown
    ]


def _inside(camera: Camera, pixels: Array, margin_px: float) -> BoolArray:
    low, high = margin_px, np.array(camera.size_px) - 1 - margin_px
    with np.errstate(invalid="ignore"):
        return np.asarray(((pixels >= low) & (pixels <= high)).all(axis=-1))


def _farther_than(least_px: float, pixels: Array, taken: Sequence[BoardView]) -> BoolArray:
    """Say which boards (n, k, 2) are so far from all views taken, root mean square, shape (n,)."""
    far = np.ones(len(pixels), dtype=bool)
    for view in taken:
        apart = pixels[:, view.points] - view.corners_px
        far &= ~(np.sqrt((apart**2).sum(axis=2).mean(axis=1)) < least_px)
    return far

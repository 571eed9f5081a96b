"""How accurate an arena is: markers at known places, measured, and the errors over the floor.

Reference: seed 001, figure 9: 360 markers 68 mm apart, e_r = sqrt(e_x^2 + e_y^2).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena.on_plane import OverheadView
from tagmetry.arena.square_fit import fit_squares
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import IntArray


@dataclass(frozen=True)
class AuditGrid:
    """Markers in rows, all alike, their tops toward the grid's y.

    Frame: `grid` has its origin in the middle, x to the right along the rows, y to the first row.
    Ids rise along the rows, from the top left.

    Attributes:
        columns: Markers in a row.
        rows: Rows.
        step_m: From centre to centre.
        size_m: Side of a black square.
        family: Of the markers.
        first_id: Of the one at the top left.
        height_m: Of the markers above the floor.
    """

    columns: int
    rows: int
    step_m: float
    size_m: float
    family: str = "tag36h11"
    first_id: int = 0
    height_m: float = 0.0

    def __post_init__(self) -> None:
        if self.columns < 1 or self.rows < 1:
            raise InputError(f"a grid has columns and rows, got {self.columns}x{self.rows}")
        if not 0 < self.size_m < self.step_m < np.inf:
            raise InputError(
                f"expected a size below the step, both positive, got {self.size_m} m and "
                f"{self.step_m} m"
            )

    @property
    def places_m(self) -> Array:
        """Centres in the grid's frame in the order of the ids, shape (n, 2)."""
        x = (np.arange(self.columns) - (self.columns - 1) / 2) * self.step_m
        y = ((self.rows - 1) / 2 - np.arange(self.rows)) * self.step_m
        return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)

    @property
    def count(self) -> int:
        """How many markers there are."""
        return self.columns * self.rows


@dataclass(frozen=True)
class GridPlace:
    """Where a grid lies in the world.

    Attributes:
        x_m: Its middle.
        y_m: Its middle.
        turn_rad: From the world's x to the grid's.
    """

    x_m: float = 0.0
    y_m: float = 0.0
    turn_rad: float = 0.0

    def in_world(self, places_m: Array) -> Array:
        """Return places of the grid in the world, shape (n, 2)."""
        c, s = np.cos(self.turn_rad), np.sin(self.turn_rad)
        return np.asarray(places_m @ np.array([[c, s], [-s, c]]) + [self.x_m, self.y_m])


@dataclass(frozen=True, eq=False)
class ErrorMap:
    """Errors over the floor.

    Attributes:
        ids: Of the markers, shape (n,).
        true_m: Where they are, (x, y) in the world, shape (n, 2).
        measured_m: Where they are said to be, shape (n, 2).
        sd_m: Stated standard deviation, root of the covariance's trace, shape (n,).
        foot_m: The point of the floor that is below the camera, shape (2,).
        place: Where the grid lies.
        missing: Ids that were not seen.
    """

    ids: IntArray
    true_m: Array
    measured_m: Array
    sd_m: Array
    foot_m: Array
    place: GridPlace
    missing: tuple[int, ...]

    @property
    def radial_m(self) -> Array:
        """Radial errors, shape (n,)."""
        return np.asarray(np.hypot(*(self.measured_m - self.true_m).T))

    @property
    def worst_m(self) -> float:
        """The largest radial error."""
        return float(self.radial_m.max())

    @property
    def rms_m(self) -> float:
        """Root of the mean squared radial error."""
        return float(np.sqrt((self.radial_m**2).mean()))

    def below_camera_m(self, within_m: float) -> float:
        """Return the largest radial error near the camera's foot; NaN where no marker is there."""
        is_near = np.hypot(*(self.true_m - self.foot_m).T) <= within_m
        return float(self.radial_m[is_near].max()) if is_near.any() else float("nan")


def audit(
    detections: Sequence[Detection],
    grid: AuditGrid,
    view: OverheadView,
    place: GridPlace | None = None,
) -> ErrorMap:
    """Return the errors at the markers of a grid.

    Args:
        detections: All markers of an image, or those of several one after another: each marker's
            places are then averaged.
        grid: The markers.
        view: The camera over the floor.
        place: Where the grid lies; when None, where it fits best, which hides errors that all
            markers have in common.

    Raises:
        InputError: Fewer than three markers of the grid are seen.
    """
    measured, sds = _measured(detections, grid, view)
    if len(measured) < 3:
        raise InputError(
            f"an audit needs three markers of the grid or more, {len(measured)} of {grid.count} "
            f"are seen; check the family {grid.family} and the first id {grid.first_id}"
        )
    ids = np.array(sorted(measured))
    found = np.array([measured[n] for n in ids.tolist()])
    own = grid.places_m[ids - grid.first_id]
    place = place if place is not None else _best_place(own, found)
    every = range(grid.first_id, grid.first_id + grid.count)
    return ErrorMap(
        ids,
        place.in_world(own),
        found,
        np.array([sds[n] for n in ids.tolist()]),
        np.asarray(view.T_world_camera.translation[:2]),
        place,
        tuple(sorted(set(every) - set(ids.tolist()))),
    )


def _measured(
    detections: Sequence[Detection], grid: AuditGrid, view: OverheadView
) -> tuple[Mapping[int, Array], Mapping[int, float]]:
    """Return mean places of the grid's markers and their standard deviations, by id."""
    last = grid.first_id + grid.count
    own = [d for d in detections if d.family == grid.family and grid.first_id <= d.id < last]
    own = [d for d in own if not d.is_duplicate]
    fits = fit_squares(
        view,
        np.array([d.corners_px for d in own]).reshape(-1, 4, 2),
        np.array([d.corners_cov_px2 for d in own]).reshape(-1, 8, 8),
        np.full(len(own), grid.size_m),
        np.full(len(own), grid.height_m),
    )
    common = fits.by_camera @ view.covariance @ np.swapaxes(fits.by_camera, 1, 2)
    ids = np.array([d.id for d in own], dtype=np.int64)
    usable = np.isfinite(fits.places).all(axis=1)
    places: dict[int, Array] = {}
    sds: dict[int, float] = {}
    for n in np.unique(ids[usable]).tolist():
        rows = usable & (ids == n)
        places[n] = fits.places[rows, :2].mean(axis=0)
        spread = fits.noise[rows].mean(axis=0) / rows.sum() + common[rows].mean(axis=0)
        sds[n] = float(np.sqrt(np.trace(spread[:2, :2])))
    return places, sds


def _best_place(own: Array, found: Array) -> GridPlace:
    """Return the place of the grid with the least squares of errors."""
    own_middle, middle = own.mean(axis=0), found.mean(axis=0)
    a, b = own - own_middle, found - middle
    turn = float(np.arctan2((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum(), (a * b).sum()))
    turned = GridPlace(0.0, 0.0, turn)
    at = middle - turned.in_world(own_middle[None])[0]
    return GridPlace(float(at[0]), float(at[1]), turn)

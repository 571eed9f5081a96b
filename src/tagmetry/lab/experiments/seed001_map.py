"""Seed 001, figure 9: the error map over 360 markers, 68 mm apart.

The camera is calibrated from rendered boards, the world from one picture of five floor markers, and
one picture of the grid is measured. Ours are places in that world; the paper's steps give places in
the camera's frame, so that the grid is laid where it fits them best.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena import GridPlace, audit
from tagmetry.camera import Camera
from tagmetry.detect import Detector
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.beside.seed001_map import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.overhead import FAMILY, GRID, board_pictures, grid_thing, photographed
from tagmetry.lab.rigs.overhead_calibration import calibrated, view_over_floor
from tagmetry.lab.rigs.overhead_paper import fitted, seen_places
from tagmetry.lab.rows import FloorError

_VIEWS = 20


@dataclass(frozen=True)
class Case:
    """One calibration and one picture of the grid.

    Attributes:
        repeat: Which, each with other noise and other places of the board.
    """

    repeat: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return the repeats."""
    return tuple(Case(repeat) for repeat in range(1 if quick else 4))


def measure(case: Case, seed: int) -> Sequence[FloorError]:
    """Return the errors of all markers by both methods."""
    rng = np.random.default_rng(seed)
    boards = board_pictures(_VIEWS, rng)
    grid = photographed([grid_thing()], rng)
    ours, _ = calibrated("tagmetry", boards)
    theirs, _ = calibrated("paper", boards)
    return [*_ours(grid, ours, case, rng), *_theirs(grid, theirs, case)]


def _ours(
    pixels: AnyPixels, camera: Camera, case: Case, rng: np.random.Generator
) -> Iterator[FloorError]:
    view = view_over_floor(camera, rng)
    found = audit(Detector([FAMILY]).detect(pixels, camera), GRID, view, GridPlace())
    errors = dict(zip(found.ids.tolist(), found.measured_m - found.true_m, strict=True))
    sds = dict(zip(found.ids.tolist(), found.sd_m.tolist(), strict=True))
    yield from _rows("tagmetry", case, errors, sds)


def _theirs(pixels: AnyPixels, camera: Camera, case: Case) -> Iterator[FloorError]:
    seen = seen_places(pixels, camera, GRID.size_m)
    ids = [marker_id for marker_id in sorted(seen) if marker_id < GRID.count]
    true = np.column_stack([GRID.places_m[ids], np.full(len(ids), np.pi / 2)])
    errors = fitted(np.array([seen[n] for n in ids]), true) - true
    yield from _rows("paper", case, dict(zip(ids, errors[:, :2], strict=True)), {})


def _rows(
    method: str, case: Case, errors: dict[int, Array], sds: dict[int, float]
) -> Iterator[FloorError]:
    nothing = np.full(2, np.nan)
    for number, (x_m, y_m) in enumerate(GRID.places_m.tolist()):
        error_x_m, error_y_m = errors.get(number, nothing).tolist()
        sd_m = sds.get(number, np.nan)
        yield FloorError(method, case.repeat, number, x_m, y_m, error_x_m, error_y_m, sd_m)


EXPERIMENT = Experiment(
    name="seed001-map",
    title="How large is the error over the floor, from below the camera to the corners?",
    source="seed 001, figure 9",
    row=FloorError,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

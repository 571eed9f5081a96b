"""Seed 001, figures 11 and 12: a marker moved over 0.81 m and turned once, on the way.

Every image is taken while it moves, with an exposure of 2 ms, and judged alone: a slider does not
drive as robots do, so nothing is followed. Ours is the place in the world that floor markers give;
the paper's steps give the place in the camera's frame, laid where it fits best.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.arena import Roster, sight
from tagmetry.camera import Camera
from tagmetry.detect import Detector
from tagmetry.geometry import Array, wrap_angle_rad
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.beside.seed001_slider import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.overhead import FAMILY, board_pictures
from tagmetry.lab.rigs.overhead_calibration import calibrated, view_over_floor
from tagmetry.lab.rigs.overhead_paper import fitted, seen_places
from tagmetry.lab.rigs.slider import DURATION_S, MARKER, places, slider_picture, way_and_turn
from tagmetry.lab.rows import SliderPlace

_VIEWS = 20


@dataclass(frozen=True)
class Case:
    """One calibration and one run of the slider.

    Attributes:
        repeat: Which.
        images: How many, from the start to the end.
    """

    repeat: int
    images: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return the repeats."""
    return tuple(Case(repeat, 25 if quick else 61) for repeat in range(1 if quick else 4))


def measure(case: Case, seed: int) -> Sequence[SliderPlace]:
    """Return the errors of way and turn in every image, by every method."""
    rng = np.random.default_rng(seed)
    boards = board_pictures(_VIEWS, rng)
    times_s = np.linspace(0, DURATION_S, case.images)
    film = [slider_picture(float(time_s), rng) for time_s in times_s]
    ours, _ = calibrated("tagmetry", boards)
    theirs, _ = calibrated("paper", boards)
    return [*_ours(film, times_s, ours, case, rng), *_theirs(film, times_s, theirs, case)]


def _ours(
    film: Sequence[AnyPixels],
    times_s: Array,
    camera: Camera,
    case: Case,
    rng: np.random.Generator,
) -> Iterator[SliderPlace]:
    detector = Detector([FAMILY])
    roster, view = Roster((MARKER,)), view_over_floor(camera, rng)
    found = np.full((len(film), 5), np.nan)
    for n, pixels in enumerate(film):
        seen = sight(detector.detect(pixels, camera), roster, view)
        if len(seen):
            variances = np.diag(seen.noise[0] + seen.common[0])
            found[n] = [*seen.places[0], *np.sqrt(variances[[0, 2]])]
    yield from _rows("tagmetry", case, times_s, found)


def _theirs(
    film: Sequence[AnyPixels], times_s: Array, camera: Camera, case: Case
) -> Iterator[SliderPlace]:
    found = np.full((len(film), 5), np.nan)
    for n, pixels in enumerate(film):
        seen = seen_places(pixels, camera, MARKER.marker_size_m)
        if MARKER.marker_id in seen:
            found[n, :3] = seen[MARKER.marker_id]
    known = np.isfinite(found[:, 0])
    found[known, :3] = fitted(found[known, :3], places(times_s)[known])
    yield from _rows("paper", case, times_s, found)


def _rows(method: str, case: Case, times_s: Array, found: Array) -> Iterator[SliderPlace]:
    """Give errors of what was found: x, y, heading, and the deviations of x and heading."""
    way_m, turn_rad = way_and_turn(times_s)
    error_m = found[:, 0] - places(times_s)[:, 0]
    error_rad = wrap_angle_rad(found[:, 2] - places(times_s)[:, 2])
    columns = (times_s, way_m, turn_rad, error_m, error_rad, found[:, 3], found[:, 4])
    for numbers in np.column_stack(columns).tolist():
        yield SliderPlace(method, case.repeat, *numbers)


EXPERIMENT = Experiment(
    name="seed001-slider",
    title="How exact are way and turn of a marker that moves?",
    source="seed 001, figures 11 and 12",
    row=SliderPlace,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

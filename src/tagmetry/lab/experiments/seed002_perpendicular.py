"""Seed 002, figures 22 to 25: is a fifth marker, perpendicular to four inclined ones, of use?

Its gain is smaller than the scatter of a few pictures. So both layouts are measured with the same
camera and the same noise of the markers that they share, many times, with corners simulated
instead of rendered, and it is the differences that are averaged.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.detect import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.lab.beside.seed002_perpendicular import FIVE, FOUR, conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.localized import Estimate, Shown, errors
from tagmetry.lab.rigs.marker_floor import CAMERA, LayoutName, Stand, camera_place, marker_map
from tagmetry.lab.rigs.simulated_corners import corner_covariances_px2, seen_corners
from tagmetry.lab.rows import Localization
from tagmetry.localize import METHODS, Localizer, MarkerMap

LAYOUTS: tuple[LayoutName, ...] = (FOUR, FIVE)
_METHOD = "joint"


@dataclass(frozen=True)
class Case:
    """Pairs of measurements from one distance.

    Attributes:
        distance_m: From the camera to the middle of the markers.
        yaw_deg: Of the camera.
        repeats: How many pairs.
    """

    distance_m: float
    yaw_deg: float
    repeats: int


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every distance and yaw."""
    distances_m = np.linspace(1, 7, 7 if quick else 13).tolist()
    yaws_deg = np.arange(-180, 180, 180 if quick else 45).tolist()
    return tuple(Case(d, yaw, 40 if quick else 100) for d in distances_m for yaw in yaws_deg)


def measure(case: Case, seed: int) -> Sequence[Localization]:
    """Return the errors of both layouts, those of a pair with the same number."""
    rng = np.random.default_rng(seed)
    five = Stand(FIVE, case.distance_m, case.yaw_deg)
    markers = marker_map(five).markers
    covariances_px2 = corner_covariances_px2(markers, camera_place(five, rng))
    rows: list[Localization] = []
    for repeat in range(case.repeats):
        T_world_camera = camera_place(five, rng)
        seen = tuple(seen_corners(markers, T_world_camera, covariances_px2, rng))
        rows += [_located(replace(five, layout=n), repeat, T_world_camera, seen) for n in LAYOUTS]
    return rows


def _located(
    stand: Stand, repeat: int, T_world_camera: RigidTransform, seen: Sequence[Detection]
) -> Localization:
    """Return how far the joint solution is off with the markers of a layout."""
    places = marker_map(stand)
    known = {marker.id for marker in places.markers}
    used = [one for one in seen if one.id in known]
    rows = errors(Shown(stand, repeat), T_world_camera, _estimates(places, used))
    return next(row for row in rows if row.method == _METHOD)


def _estimates(places: MarkerMap, seen: Sequence[Detection]) -> Iterator[Estimate]:
    pose = Localizer(places, CAMERA, METHODS[_METHOD]).locate(seen)
    if pose.hypotheses:
        best = pose.best
        yield Estimate(_METHOD, best.T_world_camera, best.covariance, best.probability)


EXPERIMENT = Experiment(
    name="seed002-perpendicular",
    title="Is a fifth marker of use that is perpendicular to four inclined ones?",
    source="seed 002, figures 22 to 25",
    row=Localization,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

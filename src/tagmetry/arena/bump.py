"""Has the camera been moved? The floor markers are compared with where they were at calibration.

What is compared is pixels with pixels: errors of the lens, of the map and of the camera's pose are
the same in both and drop out. With r the corners now minus those at calibration and C their change
with the camera's pose,

    d = (C^T W C)^-1 C^T W r,   chi2_camera = d^T (C^T W C) d      6 degrees of freedom

is how the camera moved. What is left over at a single marker tells that this marker was moved. A
shift of `tolerated_px`, as warmth makes it, is allowed for in W.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtri

from tagmetry.arena.on_plane import OverheadView
from tagmetry.detect import Detection
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.localize import MarkerMap
from tagmetry.markers.bodies import MarkerKey

_CAMERA_FREEDOM = 6
_LEAST_CAMERA_WEIGHT = 1e-12


@dataclass(frozen=True, eq=False)
class FloorCorners:
    """Where a floor marker was in the image at calibration.

    Attributes:
        marker: Which one.
        corners_px: Shape (4, 2).
        deviation_px: Standard deviation along each axis.
    """

    marker: MarkerKey
    corners_px: Array
    deviation_px: float


@dataclass(frozen=True, eq=False)
class BumpCheck:
    """What one image says of the camera's place.

    Attributes:
        is_moved: The camera is not where it was.
        moved: By how much: (translation, rotation vector) in the world frame, m and rad, shape
            (6,); NaN where too few floor markers are seen.
        shift_px: Root of the mean square of the corners' shifts; NaN where none is seen.
        chi2: Of the camera's motion, with six degrees of freedom.
        limit: The chi2 from which on the camera is taken to be moved.
        moved_markers: Floor markers that do not lie where they did, while the camera stays.
        seen: How many floor markers the image shows.
    """

    is_moved: bool
    moved: Array
    shift_px: float
    chi2: float
    limit: float
    moved_markers: tuple[MarkerKey, ...]
    seen: int

    @property
    def told(self) -> str:
        """The finding in words."""
        if self.seen == 0:
            return "no floor marker is seen: whether the camera was moved is not known"
        if self.is_moved:
            away_mm, turned_deg = (
                1000 * np.linalg.norm(self.moved[:3]),
                np.degrees(np.linalg.norm(self.moved[3:])),
            )
            return (
                f"the camera was moved: floor markers are {self.shift_px:.2f} px from where they "
                f"were (chi2 {self.chi2:.0f}, limit {self.limit:.0f}), as of {away_mm:.1f} mm and "
                f"{turned_deg:.2f} degrees; calibrate anew"
            )
        if self.moved_markers:
            ids = ", ".join(str(one.id) for one in self.moved_markers)
            return f"floor markers {ids} were moved or are half covered; the camera was not moved"
        return f"the camera is where it was ({self.shift_px:.2f} px by {self.seen} floor markers)"


@dataclass(frozen=True)
class BumpRules:
    """When a camera is taken to be moved.

    Attributes:
        tolerated_px: A shift that is no alarm, standard deviation.
        false_alarms: Probability of a false alarm at one image.
    """

    tolerated_px: float = 0.2
    false_alarms: float = 1e-9

    def __post_init__(self) -> None:
        if not (0 <= self.tolerated_px < np.inf and 0 < self.false_alarms < 1):
            raise InputError(f"expected tolerated_px >= 0 and false_alarms 0 to 1, got {self}")


def floor_corners(detections: Sequence[Detection], floor: MarkerMap) -> tuple[FloorCorners, ...]:
    """Return the floor markers of an image, to be compared with later ones."""
    return tuple(
        FloorCorners(
            MarkerKey(one.family, one.id),
            one.corners_px,
            float(np.sqrt(np.trace(one.corners_cov_px2) / 8)),
        )
        for one in detections
        if MarkerKey(one.family, one.id) in floor.by_key and not one.is_duplicate
    )


def check_bump(
    detections: Sequence[Detection],
    reference: Sequence[FloorCorners],
    floor: MarkerMap,
    view: OverheadView,
    rules: BumpRules | None = None,
) -> BumpCheck:
    """Return whether the camera is still where it was at calibration.

    Args:
        detections: All markers of an image.
        reference: The floor markers' corners at calibration.
        floor: The floor markers at their places in the world.
        view: The camera at calibration.
        rules: When it is taken to be moved.
    """
    rules = rules or BumpRules()
    limit = float(chdtri(_CAMERA_FREEDOM, rules.false_alarms))
    pairs = _pairs(detections, reference, floor)
    if not pairs:
        return BumpCheck(False, np.full(6, np.nan), float("nan"), 0.0, limit, (), 0)
    compared = [_Compared.of(now, before, floor, view, rules) for now, before in pairs]
    kept, moved, chi2 = _explained(compared, rules)
    shifts = np.array([one.shift_px for one in compared if one in kept])
    loose = tuple(one.marker for one in compared if one not in kept)
    rms_px = float(np.sqrt((shifts**2).sum(axis=-1).mean()))
    return BumpCheck(chi2 > limit, moved, rms_px, chi2, limit, loose, len(pairs))


@dataclass(frozen=True, eq=False)
class _Compared:
    """One marker: its corners' shift (4, 2), d(corners) / d(camera) (8, 6), and weight (8, 8)."""

    marker: MarkerKey
    shift_px: Array
    by_camera: Array
    weight: Array

    @classmethod
    def of(
        cls,
        now: Detection,
        before: FloorCorners,
        floor: MarkerMap,
        view: OverheadView,
        rules: BumpRules,
    ) -> "_Compared":
        p_world = floor.by_key[before.marker].p_world
        by_camera = view.by_camera(p_world, view.project(p_world)[1]).reshape(8, 6)
        allowed_px2 = before.deviation_px**2 + rules.tolerated_px**2
        weight = np.asarray(
            np.linalg.inv(now.corners_cov_px2 + allowed_px2 * np.eye(8)), dtype=np.float64
        )
        return cls(before.marker, now.corners_px - before.corners_px, by_camera, weight)

    def chi2(self, moved: Array) -> float:
        """Return how badly a motion of the camera explains this marker's shift."""
        off = self.shift_px.ravel() - self.by_camera @ moved
        return float(off @ self.weight @ off)


def _pairs(
    detections: Sequence[Detection], reference: Sequence[FloorCorners], floor: MarkerMap
) -> list[tuple[Detection, FloorCorners]]:
    known = {one.marker: one for one in reference if one.marker in floor.by_key}
    keys = [MarkerKey(one.family, one.id) for one in detections]
    return [
        (one, known[key])
        for one, key in zip(detections, keys, strict=True)
        if key in known and not one.is_duplicate
    ]


def _explained(compared: list[_Compared], rules: BumpRules) -> tuple[list[_Compared], Array, float]:
    """Return the markers that one motion of the camera explains, that motion, and its chi2.

    The worst marker is left out until the rest agree; two are always kept.
    """
    kept = list(compared)
    limit = float(chdtri(8, rules.false_alarms))
    while True:
        moved, chi2 = _motion(kept)
        left = [one.chi2(moved) for one in kept]
        if len(kept) <= 2 or max(left) <= limit:
            return kept, moved, chi2
        without = [[one for one in kept if one is not other] for other in kept]
        kept = min(without, key=_misfit)


def _motion(compared: list[_Compared]) -> tuple[Array, float]:
    """Return the camera's motion, shape (6,), and the chi2 that it explains."""
    H = sum((one.by_camera.T @ one.weight @ one.by_camera for one in compared), np.zeros((6, 6)))
    g = sum((one.by_camera.T @ one.weight @ one.shift_px.ravel() for one in compared), np.zeros(6))
    moved = np.linalg.pinv(H, rcond=_LEAST_CAMERA_WEIGHT, hermitian=True) @ g
    return moved, float(moved @ H @ moved)


def _misfit(compared: list[_Compared]) -> float:
    moved, _ = _motion(compared)
    return sum(one.chi2(moved) for one in compared)

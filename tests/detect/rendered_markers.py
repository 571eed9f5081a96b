"""One rendered marker whose corners are known, in any size, tilt, lens and light."""

from dataclasses import dataclass

import numpy as np

from tagmetry import markers
from tagmetry.camera import Camera
from tagmetry.camera.brown_lens import BrownLens
from tagmetry.detect import Detection, Detector
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, marker_corners_m
from tagmetry.twin import Look, render

FOCAL_PX = 1400.0
SIZE_M = 0.1


@dataclass(frozen=True, eq=False)
class Scene:
    """A picture, the camera that took it, and where the marker's corners truly are."""

    grey: np.ndarray
    camera: Camera
    corners_px: Array


def scene(
    rng: np.random.Generator,
    side_px: float = 60.0,
    *,
    tilt_deg: float = 0.0,
    look: Look | None = None,
    coefficients: tuple[float, ...] = (),
    aside_px: float = 0.0,
    family: str = "tag36h11",
    marker_id: int = 7,
) -> Scene:
    """Render a marker turned at random about its normal, tilted, near the middle or `aside_px`."""
    layout = markers.family(family).layout
    around = 1 + 2 * layout.margin_cells / layout.side_cells
    half_px = int(0.9 * around * side_px + 16 + aside_px)
    camera = Camera(
        2 * half_px + 1,
        2 * half_px + 1,
        (FOCAL_PX, FOCAL_PX),
        (float(half_px), float(half_px)),
        BrownLens(coefficients),
    )
    distance_m = FOCAL_PX * SIZE_M / side_px
    roll, axis = rng.uniform(-180, 180), rng.uniform(0, 2 * np.pi)
    tilt = Rotation.from_rotvec(np.radians(tilt_deg) * np.array([np.cos(axis), np.sin(axis), 0]))
    facing = Rotation.from_euler("x", 180, degrees=True)
    turned = tilt * facing * Rotation.from_euler("z", roll, degrees=True)
    offset_px = rng.uniform(-0.5, 0.5, 2) + aside_px / np.sqrt(2)
    place = np.array([*(offset_px * distance_m / FOCAL_PX), distance_m])
    T_camera_marker = RigidTransform.from_components(place, turned)
    marker = MountedMarker(family, marker_id, SIZE_M, RigidTransform.identity())
    grey = render([marker], T_camera_marker, camera, rng, look)
    truth = camera.project(T_camera_marker.apply(marker_corners_m(SIZE_M)))
    return Scene(grey, camera, truth)


@dataclass(frozen=True, eq=False)
class Trials:
    """Errors of n repeated measurements and the squared distances by their own covariances."""

    errors_px: Array
    mahalanobis2: Array
    missed: int

    @property
    def rms_px(self) -> float:
        return float(np.sqrt((self.errors_px**2).mean()))

    @property
    def mean_distance2(self) -> float:
        """Mean squared Mahalanobis distance of the eight coordinates, without the worst 2 %."""
        kept = np.sort(self.mahalanobis2)[: max(1, int(0.98 * len(self.mahalanobis2)))]
        return float(kept.mean())


def trials(count: int, seed: int, *, camera_known: bool = False, **wanted: object) -> Trials:
    """Detect `count` scenes; `wanted` goes to `scene`."""
    rng = np.random.default_rng(seed)
    detector, errors, distances2 = Detector(), [], []
    for _ in range(count):
        shown = scene(rng, **wanted)
        found = detector.detect(shown.grey, shown.camera if camera_known else None)
        if found:
            error = (found[0].corners_px - shown.corners_px).ravel()
            errors.append(error)
            distances2.append(error @ np.linalg.solve(found[0].corners_cov_px2, error))
    return Trials(np.array(errors), np.array(distances2), count - len(errors))


def bound_px(side_px: float, blur_px: float, snr: float) -> float:
    """Return the least standard deviation of a corner's coordinate (four sides, white noise).

    Two lines fitted to blurred steps meet in the corner; the blur includes the pixel's own square.
    """
    spread_px = np.hypot(blur_px, np.sqrt(1 / 12))
    return float(2 * np.sqrt(2 * np.sqrt(np.pi) * spread_px / side_px) / snr)


def only(found: tuple[Detection, ...]) -> Detection:
    """Return the one detection that there is."""
    (one,) = found
    return one

"""Pictures of markers on a floor, localized by every method, and how far each is off."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detector
from tagmetry.geometry import (
    Array,
    RigidTransform,
    mahalanobis_squared,
    pose_difference,
    wrap_angle_rad,
)
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.lab.rigs.marker_floor import (
    CAMERA,
    FAMILY,
    Stand,
    angles_rad,
    camera_place,
    marker_map,
    picture,
)
from tagmetry.lab.rigs.opencv_corners import opencv_corners
from tagmetry.lab.rigs.paper_localization import fused_place
from tagmetry.lab.rows import Localization
from tagmetry.localize import METHODS, Localizer, MarkerMap

PAPER = {"paper, 1 / distance": 1.0, "paper, 1 / distance^2": 2.0}
"""The paper's methods with their own corners: the power of the distance in the weight."""

PAPER_OUR_CORNERS = "paper, our corners"

_UNKNOWN = np.full((6, 6), np.nan)


@dataclass(frozen=True, eq=False)
class Estimate:
    """What a method says of the camera's pose.

    Attributes:
        method: Its name.
        T_world_camera: The pose.
        covariance: (6, 6), on the left in the world frame, m and rad; NaN where none is stated.
        probability: Of the pose, against its alternatives; NaN where none is stated.
    """

    method: str
    T_world_camera: RigidTransform
    covariance: Array
    probability: float


def method_names() -> tuple[str, ...]:
    """Return the names of all methods: the paper's, then ours."""
    return (*PAPER, PAPER_OUR_CORNERS, *METHODS)


def estimates(pixels: AnyPixels, places: MarkerMap, camera: Camera = CAMERA) -> Iterator[Estimate]:
    """Give the camera's pose by every method that finds one.

    Args:
        pixels: The picture.
        places: Where the markers are taken to be.
        camera: The intrinsics that are taken to be right.
    """
    found = Detector([FAMILY]).detect(pixels, camera)
    theirs = opencv_corners(pixels)
    own = {detection.id: detection.corners_px for detection in found}
    for name, (corners_px, power) in {
        **{name: (theirs, power) for name, power in PAPER.items()},
        PAPER_OUR_CORNERS: (own, 1.0),
    }.items():
        if (T := fused_place(corners_px, places, camera, power)) is not None:
            yield Estimate(name, T, _UNKNOWN, np.nan)
    for name in METHODS:
        pose = Localizer(places, camera, METHODS[name]).locate(found)
        if pose.hypotheses:
            best = pose.best
            yield Estimate(name, best.T_world_camera, best.covariance, best.probability)


@dataclass(frozen=True)
class Shown:
    """A picture and how it was measured.

    Attributes:
        stand: What it shows.
        repeat: Which picture it is.
        zone: Of the picture that the markers are in; -1 where that is not varied.
        assumed: What was taken to be true.
    """

    stand: Stand
    repeat: int
    zone: int = -1
    assumed: str = "right"


def localized_repeatedly(stand: Stand, repeats: int, seed: int) -> Iterator[Localization]:
    """Give how far every method is off in pictures of a stand, all that it takes being right."""
    rng = np.random.default_rng(seed)
    for repeat in range(repeats):
        T_world_camera = camera_place(stand, rng)
        pixels = picture(stand, T_world_camera, rng)
        yield from localized(Shown(stand, repeat), T_world_camera, pixels)


def localized(
    shown: Shown, T_world_camera: RigidTransform, pixels: AnyPixels
) -> Iterator[Localization]:
    """Give how far every method is off in a picture, everything that it takes being right."""
    return errors(shown, T_world_camera, estimates(pixels, marker_map(shown.stand)))


def errors(
    shown: Shown, T_world_camera: RigidTransform, found: Iterator[Estimate]
) -> Iterator[Localization]:
    """Give how far every method is off; NaN for one that found no pose.

    Args:
        shown: The picture.
        T_world_camera: Where the camera truly is.
        found: What the methods say.
    """
    stand, by_name = shown.stand, {one.method: one for one in found}
    for name in method_names():
        one = by_name.get(name)
        yield Localization(
            name,
            stand.layout,
            stand.look,
            stand.distance_m,
            stand.yaw_deg,
            stand.pitch_deg,
            stand.roll_deg,
            shown.zone,
            shown.assumed,
            shown.repeat,
            *(_numbers(one, T_world_camera) if one else [float("nan")] * 9),
        )


def _numbers(one: Estimate, T_world_camera: RigidTransform) -> list[float]:
    """Return the row's numbers from `radial_m` on."""
    error = pose_difference(one.T_world_camera, T_world_camera)
    turned = wrap_angle_rad(angles_rad(one.T_world_camera) - angles_rad(T_world_camera))
    variances = np.diag(one.covariance)
    is_stated = np.isfinite(variances).all()
    return [
        float(np.linalg.norm(error[:3])),
        float(np.linalg.norm(error[:2])),
        float(error[2]),
        float(np.abs(turned).mean()),
        float(np.linalg.norm(error[3:])),
        float(np.sqrt(variances[:3].sum())),
        float(np.sqrt(variances[3:]).mean()),
        float(mahalanobis_squared(error, one.covariance)) if is_stated else float("nan"),
        one.probability,
    ]

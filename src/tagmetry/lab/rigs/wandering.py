"""A camera that wanders above markers as the filter's motion model has it.

    dv = a dW,  dw = b dW',  with W and W' independent Wiener processes

from rest. Images are taken in even steps; then all markers are covered for a while, and one more
image is taken.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.detect import Detector
from tagmetry.geometry import (
    RigidTransform,
    mahalanobis_squared,
    perturb_pose,
    pose_difference,
)
from tagmetry.lab.rigs.marker_floor import (
    CAMERA,
    FAMILY,
    Stand,
    camera_place,
    marker_map,
    picture,
)
from tagmetry.lab.rows import Followed
from tagmetry.localize import METHODS, CameraPose, Localizer
from tagmetry.localize.filter import FilteredPose, Motion, PoseFilter

MOTION = Motion(acceleration_m_s2=0.2, turning_rad_s2=0.03)
STEP_S = 0.1
LOSS_S = 2.0
FILTER = "filter"
"""The joint solution of every image, followed over time."""

_FINE = 10  # steps of the simulation between two images


@dataclass(frozen=True, eq=False)
class _Moment:
    gap_s: float
    time_s: float
    T_world_camera: RigidTransform


def followed_methods() -> tuple[str, ...]:
    """Return the names of all methods, the filter last."""
    return (*METHODS, FILTER)


def followed(stand: Stand, images: int, repeat: int, seed: int) -> Iterator[Followed]:
    """Give how far every method is off in the images of one way, and after the loss."""
    rng, places, follower = np.random.default_rng(seed), marker_map(stand), PoseFilter(MOTION)
    for number, moment in enumerate(_way(camera_place(stand, rng), images, rng)):
        seen = Detector([FAMILY]).detect(picture(stand, moment.T_world_camera, rng), CAMERA)
        told: dict[str, CameraPose | FilteredPose] = {
            name: pose
            for name in METHODS
            if (pose := Localizer(places, CAMERA, METHODS[name]).locate(seen)).hypotheses
        }
        joint = told.get("joint")
        if isinstance(joint, CameraPose) and (now := follower.take(moment.time_s, joint)):
            told[FILTER] = now
        for name in followed_methods():
            yield Followed(
                name, stand.layout, stand.distance_m, repeat, number, moment.gap_s,
                *_errors(told.get(name), moment.T_world_camera),
            )  # fmt: skip


def _way(start: RigidTransform, images: int, rng: np.random.Generator) -> Iterator[_Moment]:
    """Give the places of so many images, and of one after the loss."""
    T, speed, rate, time_s = start, np.zeros(3), np.zeros(3), 0.0
    yield _Moment(0.0, time_s, T)
    for gap_s in [*[STEP_S] * (images - 1), LOSS_S]:
        steps = round(_FINE * gap_s / STEP_S)
        step_s = gap_s / steps
        for _ in range(steps):
            T = perturb_pose(T, step_s * np.concatenate([speed, rate]))
            speed = speed + MOTION.acceleration_m_s2 * np.sqrt(step_s) * rng.normal(size=3)
            rate = rate + MOTION.turning_rad_s2 * np.sqrt(step_s) * rng.normal(size=3)
        time_s += gap_s
        yield _Moment(gap_s, time_s, T)


def _errors(
    one: CameraPose | FilteredPose | None, T_world_camera: RigidTransform
) -> tuple[float, float, float, float]:
    """Return shift in metres, angle in radians, squared Mahalanobis distance, and surprise."""
    if one is None:
        return (float("nan"),) * 4
    error = pose_difference(one.T_world_camera, T_world_camera)
    surprise2 = one.surprise2 if isinstance(one, FilteredPose) else float("nan")
    return (
        float(np.linalg.norm(error[:3])),
        float(np.linalg.norm(error[3:])),
        float(mahalanobis_squared(error, one.covariance)),
        surprise2,
    )

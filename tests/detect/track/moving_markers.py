"""Rendered images of markers that move, with the truth of their corners."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detection, Detector, Tracker
from tagmetry.geometry import Array, RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker, marker_corners_m
from tagmetry.twin import Look, Optics, Scene, Shot, Shutter, photograph, render
from tagmetry.twin.scenes import Steady, Still, marker_thing

FOCAL_PX = 800.0
SIZE_M = 0.1
STEP_S = 1 / 30
CAMERA = Camera(320, 240, (FOCAL_PX, FOCAL_PX), (159.5, 119.5))


@dataclass(frozen=True)
class Shown:
    """A marker in one image: its middle, its side, how it is turned (as seen) and tilted."""

    id: int
    x_px: float
    y_px: float
    side_px: float = 48.0
    turn_deg: float = 20.0
    tilt_deg: float = 15.0
    family: str = "tag36h11"

    def mounted(self, camera: Camera = CAMERA) -> MountedMarker:
        ray = camera.unproject(np.array([self.x_px, self.y_px]))
        turned = Rotation.from_euler("zxy", [self.turn_deg, 180, self.tilt_deg], degrees=True)
        depth_m = FOCAL_PX * SIZE_M / self.side_px
        T_camera_marker = RigidTransform.from_components(ray / ray[2] * depth_m, turned)
        return MountedMarker(self.family, self.id, SIZE_M, T_camera_marker)

    def corners_px(self, camera: Camera = CAMERA) -> Array:
        T_camera_marker = self.mounted(camera).T_body_marker
        return camera.project(T_camera_marker.apply(marker_corners_m(SIZE_M)))


def image(
    shown: Sequence[Shown], seed: int = 0, look: Look | None = None, camera: Camera = CAMERA
) -> np.ndarray:
    """Return a grey image of markers."""
    mounted = [one.mounted(camera) for one in shown]
    rng = np.random.default_rng(seed)
    return render(mounted, RigidTransform.identity(), camera, rng, look or Look())


def smeared(shown: Shown, velocity_px_s: tuple[float, float], exposure_s: float) -> np.ndarray:
    """Return a grey image of one marker that moves while light is taken in."""
    mounted = shown.mounted()
    depth_m = mounted.T_body_marker.translation[2]
    velocity_m_s = np.array([*velocity_px_s, 0.0]) * depth_m / FOCAL_PX
    still = replace(mounted, T_body_marker=RigidTransform.identity())
    thing = marker_thing([still], Steady(mounted.T_body_marker, velocity_m_s, np.zeros(3)))
    shot = Shot(
        CAMERA,
        Still(RigidTransform.identity()),
        optics=Optics(blur_px=0.6),
        shutter=Shutter(exposure_s=exposure_s),
    )
    return photograph(Scene((thing,), background=0.45), shot, np.random.default_rng(3))


def along(first: Shown, count: int, **per_image: float) -> Iterator[Shown]:
    """Give a marker that changes by the same amount from image to image."""
    for k in range(count):
        changed = {name: getattr(first, name) + k * by for name, by in per_image.items()}
        yield replace(first, **changed)


def tracked(
    tracker: Tracker, images: Sequence[Sequence[Shown]], look: Look | None = None
) -> list[tuple[Detection, ...]]:
    """Return what a tracker reports of images at 30 per second."""
    return [
        tracker.track(image(shown, seed=k, look=look), k * STEP_S) for k, shown in enumerate(images)
    ]


def ids(found: Sequence[Detection]) -> list[int]:
    return [one.id for one in found]


def error_px(found: Sequence[Detection], shown: Shown) -> float:
    """Return the largest error of the corners of one marker."""
    (own,) = [one for one in found if (one.family, one.id) == (shown.family, shown.id)]
    return float(np.abs(own.corners_px - shown.corners_px()).max())


def small_tracker(**wanted: object) -> Tracker:
    return Tracker(Detector(min_side_px=16), **wanted)

"""Pictures by the twin of what is planned, measured, and how far off they are."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from tagmetry.camera import BrownLens, Camera, cropped
from tagmetry.detect import Detection, Detector
from tagmetry.geometry import Array, RigidTransform, pose_difference
from tagmetry.geometry.arrays import AnyPixels
from tagmetry.markers import MountedMarker
from tagmetry.pose import estimate_pose
from tagmetry.pose.plan import Imaging, Setup
from tagmetry.twin import Optics, Scene, Shot, Shutter, exposed
from tagmetry.twin.optics.sensor import Sensor, developed
from tagmetry.twin.scenes import Steady, Still, marker_thing

HERE = Still(RigidTransform.identity())
PICTURES_OF_A_PLACE = 5
CAMERA = Camera(
    1280,
    960,
    (1000.0, 1003.0),
    (645.0, 470.0),
    BrownLens((-0.12, 0.05, 0.0004, -0.0003, 0.0)),
    covariance=np.diag([0.6, 0.6, 0.5, 0.5, 5e-4, 1e-3, 5e-5, 5e-5, 1e-4]) ** 2,
)


def planned(number: int) -> Setup:
    """One of 50 set-ups over which everything changes, each at its own pace."""
    size_m = (0.12, 0.05, 0.2, 0.08, 0.03)[number % 5]
    side_px = (24.0, 34.0, 48.0, 70.0, 100.0, 150.0, 29.0)[number % 7]
    tilt_deg = (30.0, 45.0, 15.0, 60.0, 25.0, 5.0)[number % 6]
    noise_grey = (2.0, 5.0, 1.0, 8.0)[number % 4]
    black_grey, white_grey = ((40.0, 190.0), (30.0, 230.0), (70.0, 160.0))[number % 3]
    imaging = Imaging(noise_grey, black_grey, white_grey, (0.6, 0.5, 0.8, 1.0)[number % 4], 0.01)
    moving_px = (0.0, 0.0, 1.5, 0.0, 3.0, 0.0, 0.0, 0.8)[number % 8]
    distance_m = size_m * CAMERA.focal_px[0] / side_px
    return Setup(
        CAMERA,
        size_m,
        distance_m,
        tilt_deg,
        direction_deg=37.0 * number,
        pixel=((640.0, 480.0), (300.0, 250.0), (1000.0, 700.0))[number % 3],
        family=("tag36h11", "4x4_50", "tag36h11", "aruco_mip_36h12", "tag25h9")[number % 5],
        speed_m_s=moving_px * distance_m / CAMERA.focal_px[0] / imaging.exposure_s,
        size_sd_m=size_m * (0.0005, 0.002)[number % 2],
        imaging=imaging,
    )


@dataclass(frozen=True)
class Sight:
    """A picture cut out around the marker, with the truth."""

    pixels: AnyPixels
    camera: Camera
    T_camera_marker: RigidTransform


def sights(setup: Setup, count: int, rng: np.random.Generator) -> Iterator[Sight]:
    """Give pictures, each few of another place within a pixel."""
    for _ in range(count // PICTURES_OF_A_PLACE):
        centre = np.array(setup.pixel) + rng.uniform(-0.5, 0.5, 2)
        here = replace(setup, pixel=tuple(centre.tolist()))
        camera, light = _light(here)
        for _ in range(PICTURES_OF_A_PLACE):
            pixels = developed(light, Sensor(noise_grey=setup.imaging.noise_grey), rng)
            yield Sight(pixels, camera, here.T_camera_marker)


def _light(setup: Setup) -> tuple[Camera, Array]:
    look = setup.imaging
    marker = MountedMarker(setup.family, 0, setup.size_m, RigidTransform.identity())
    velocity = np.array([setup.speed_m_s, 0.0, 0.0])
    path = Steady(setup.T_camera_marker, velocity, np.zeros(3))
    paper, ink = look.white_grey / 255, look.black_grey / 255
    scene = Scene((marker_thing([marker], path, paper=paper, ink=ink),), background=0.45)
    shot = Shot(
        _cut_out(setup),
        HERE,
        optics=Optics(blur_px=look.blur_px),
        shutter=Shutter(look.exposure_s if setup.speed_m_s else 0.0),
    )
    return shot.camera, exposed(scene, shot)


def _cut_out(setup: Setup) -> Camera:
    """Return the camera of the part of the image that the marker's paper reaches, and some more."""
    low, high = setup.corners_px.min(axis=0), setup.corners_px.max(axis=0)
    spare = 0.4 * (high - low) + 14
    left, top = np.floor(low - spare).astype(int).tolist()
    width, height = np.ceil(high - low + 2 * spare).astype(int).tolist()
    return cropped(setup.camera, left, top, width, height)


@dataclass(frozen=True)
class Errors:
    """Of the poses of m pictures in which the marker was found.

    Attributes:
        by_corners: With camera and size known, shape (m, 6), m and rad.
        of_all: With intrinsics and sizes drawn from what is known of them, shape (m, 6).
        found: Share of the pictures.
        flipped: Share of poses whose other hypothesis is nearer to the truth; not in the others.
    """

    by_corners: Array
    of_all: Array
    found: float
    flipped: float


def measured(setup: Setup, count: int, rng: np.random.Generator) -> Errors:
    """Measure the marker in pictures."""
    detector = Detector([setup.family])
    by_corners, of_all, found, flips = [], [], 0, 0
    for sight in sights(setup, count, rng):
        seen = [one for one in detector.detect(sight.pixels, sight.camera) if one.id == 0]
        if len(seen) != 1:
            continue
        found += 1
        error = _error(seen[0], sight.camera, setup.size_m, sight.T_camera_marker)
        if error is None:
            flips += 1
            continue
        by_corners.append(error)
        size_m = setup.size_m + setup.size_sd_m * rng.standard_normal()
        assumed = _drawn(sight.camera, rng)
        error = _error(seen[0], assumed, size_m, sight.T_camera_marker)
        if error is not None:
            of_all.append(error)
    return Errors(np.array(by_corners), np.array(of_all), found / count, flips / max(found, 1))


def _error(seen: Detection, camera: Camera, size_m: float, truth: RigidTransform) -> Array | None:
    """Return how far a pose is off, None for one that is flipped."""
    pose = estimate_pose(seen, camera, size_m)
    errors = [pose_difference(one.T_camera_marker, truth) for one in pose.hypotheses]
    turns = [np.linalg.norm(error[3:]) for error in errors]
    return errors[0] if turns[0] == min(turns) else None


def _drawn(camera: Camera, rng: np.random.Generator) -> Camera:
    """Return a camera as another calibration would have found it."""
    numbers = np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients])
    fx, fy, cx, cy, *bends = rng.multivariate_normal(numbers, camera.covariance).tolist()
    lens = BrownLens(tuple(bends))
    return replace(camera, focal_px=(fx, fy), center_px=(cx, cy), lens=lens)

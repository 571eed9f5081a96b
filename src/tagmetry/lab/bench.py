"""How fast is it, against the peers in the same run?

Every contender sees the same rendered pictures, after a warm-up, in turns, so that a loaded machine
hits all alike; the median of each is compared as a ratio. Peers: OpenCV's detector, and the
AprilTag library where its Python package is installed.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np

from tagmetry.camera import Camera
from tagmetry.detect import Detector
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.pose import estimate_poses
from tagmetry.twin import Look, render

FAMILY = "tag36h11"
SIZE_M = 0.1
Contender = Callable[[GreyPixels], int]


@dataclass(frozen=True)
class Case:
    """One picture to measure."""

    name: str
    pixels: GreyPixels
    camera: Camera
    marker_count: int


@dataclass(frozen=True)
class Timing:
    """One contender on one picture.

    Attributes:
        case: Name of the picture.
        contender: Who ran.
        threads: How many threads OpenCV and the AprilTag library were allowed.
        found: How many markers were found.
        expected: How many the picture shows.
        median_ms: Median time.
        worst_ms: Longest time.
        ratio: Median by that of tagmetry's detector on the same picture and threads.
    """

    case: str
    contender: str
    threads: int
    found: int
    expected: int
    median_ms: float
    worst_ms: float
    ratio: float


def bench(cases: Sequence[Case], threads: int, repeats: int) -> list[Timing]:
    """Time all contenders on all pictures."""
    import cv2

    before = cv2.getNumThreads()
    cv2.setNumThreads(threads)
    try:
        return [row for case in cases for row in _timed(case, threads, repeats)]
    finally:
        cv2.setNumThreads(before)


def standard_cases(rng: np.random.Generator) -> list[Case]:
    """Return the pictures: sizes from a webcam's to full HD, few and many markers, noise."""
    return [
        case("640x480, 1 marker", (640, 480), 1, 90, rng),
        case("1280x720, 6 markers", (1280, 720), 6, 90, rng),
        case("1920x1080, 24 markers", (1920, 1080), 24, 60, rng),
        case("1920x1080, 24 markers, noise 8", (1920, 1080), 24, 60, rng, noise=8.0),
        case("1920x1080, none", (1920, 1080), 0, 60, rng),
    ]


def case(
    name: str,
    size_px: tuple[int, int],
    marker_count: int,
    side_px: float,
    rng: np.random.Generator,
    noise: float = 2.0,
) -> Case:
    """Return a picture of tilted markers in rows, each about side_px large."""
    width_px, height_px = size_px
    camera = Camera(
        width_px, height_px, (width_px, width_px), ((width_px - 1) / 2, (height_px - 1) / 2)
    )
    depth_m = SIZE_M * width_px / side_px
    columns = max(1, int(np.ceil(np.sqrt(marker_count * width_px / height_px))))
    rows = max(1, -(-marker_count // columns))
    markers = [
        MountedMarker(FAMILY, n, SIZE_M, _tilted(camera, columns, rows, n, depth_m, rng))
        for n in range(marker_count)
    ]
    look = Look(noise=noise)
    pixels = render(markers, RigidTransform.identity(), camera, rng, look)
    return Case(name, pixels, camera, marker_count)


def _tilted(
    camera: Camera, columns: int, rows: int, n: int, depth_m: float, rng: np.random.Generator
) -> RigidTransform:
    u = (n % columns + 0.5) * camera.width_px / columns
    v = (n // columns + 0.5) * camera.height_px / rows
    ray = camera.unproject(np.array([u, v]))
    turn_deg, tilt_deg, lean_deg = rng.uniform([-180, -35, -35], [180, 35, 35])
    R_camera_marker = Rotation.from_euler("xyz", [180 + tilt_deg, lean_deg, turn_deg], degrees=True)
    return RigidTransform.from_components(ray / ray[2] * depth_m, R_camera_marker)


def _timed(one: Case, threads: int, repeats: int) -> list[Timing]:
    contenders = _contenders(one, threads)
    found = {name: run(one.pixels) for name, run in contenders.items()}  # warms up
    times_ms: dict[str, list[float]] = {name: [] for name in contenders}
    for _ in range(repeats):
        for name, run in contenders.items():
            start_s = time.perf_counter()
            run(one.pixels)
            times_ms[name].append(1000 * (time.perf_counter() - start_s))
    medians = {name: float(np.median(times)) for name, times in times_ms.items()}
    own = medians["tagmetry detect"]
    return [
        Timing(
            one.name,
            name,
            threads,
            found[name],
            one.marker_count,
            medians[name],
            max(times_ms[name]),
            medians[name] / own,
        )
        for name in contenders
    ]


def _contenders(one: Case, threads: int) -> dict[str, Contender]:
    detector = Detector([FAMILY])

    def detect_and_measure(pixels: GreyPixels) -> int:
        found = detector.detect(pixels, one.camera)
        return len(estimate_poses(found, one.camera, [SIZE_M] * len(found)))

    contenders: dict[str, Contender] = {
        "tagmetry detect": lambda pixels: len(detector.detect(pixels)),
        "tagmetry detect and pose": detect_and_measure,
        "OpenCV aruco, subpixel": _opencv(),
    }
    if find_spec("pyapriltags") is not None:
        contenders["AprilTag library"] = _apriltag(threads, quad_decimate=1.0)
        contenders["AprilTag library, decimated"] = _apriltag(threads, quad_decimate=2.0)
    return contenders


def _opencv() -> Contender:
    import cv2

    parameters = cv2.aruco.DetectorParameters()
    parameters.cornerRefinementMethod = cv2.aruco.CORNER_REFINE_SUBPIX
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    detector = cv2.aruco.ArucoDetector(dictionary, parameters)
    return lambda pixels: len(detector.detectMarkers(pixels)[0])


def _apriltag(threads: int, quad_decimate: float) -> Contender:
    from pyapriltags import Detector as AprilTagDetector

    detector = AprilTagDetector(FAMILY, nthreads=threads, quad_decimate=quad_decimate)
    return lambda pixels: len(detector.detect(pixels))

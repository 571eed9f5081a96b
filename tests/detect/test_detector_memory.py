"""A camera runs for days: images leave nothing behind."""

from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.detect import Detector
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MountedMarker
from tagmetry.twin import Look, render

STATUS = Path("/proc/self/status")
MOST_BYTES_PER_IMAGE = 300  # of the process, by pages of 4096


def resident_bytes() -> int:
    line = next(line for line in STATUS.read_text().splitlines() if line.startswith("VmRSS"))
    return 1024 * int(line.split()[1])


def pictures(count: int) -> list[np.ndarray]:
    """Two markers each, in 320 x 240 pixels."""
    rng = np.random.default_rng(9)
    camera = Camera(320, 240, (400.0, 400.0), (159.5, 119.5))
    down = RigidTransform.from_components(
        np.array([0.0, 0.0, 0.8]), Rotation.from_euler("x", 180, degrees=True)
    )
    return [
        render(
            [
                MountedMarker("tag36h11", 2 * k + side, 0.1, lying_at(0.2 * side - 0.1, rng))
                for side in (0, 1)
            ],
            down,
            camera,
            rng,
            Look(noise=3.0),
        )
        for k in range(count)
    ]


def lying_at(x_m: float, rng: np.random.Generator) -> RigidTransform:
    turn = Rotation.from_euler("z", rng.uniform(0, 360), degrees=True)
    return RigidTransform.from_components(np.array([x_m, rng.uniform(-0.05, 0.05), 0.0]), turn)


def growth_bytes() -> int:
    """Return by how much this process grows from its thousandth image to its ten thousandth.

    In one of its own, where the memory of other tests does not count.
    """
    images, detector = pictures(20), Detector()
    assert all(len(detector.detect(image)) == 2 for image in images)
    held = []
    for number in range(10_000):
        detector.detect(images[number % len(images)])
        if number in (999, 9_999):
            held.append(resident_bytes())
    return held[1] - held[0]


@pytest.mark.slow
@pytest.mark.skipif(not STATUS.exists(), reason="this system does not tell what a process holds")
def test_the_ten_thousandth_image_takes_no_more_memory_than_the_thousandth() -> None:
    with ProcessPoolExecutor(1, get_context("spawn")) as alone:
        assert alone.submit(growth_bytes).result() < MOST_BYTES_PER_IMAGE * 9_000

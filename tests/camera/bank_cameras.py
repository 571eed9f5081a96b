"""A camera whose focus breathes, exact at any focus, and calibrations of it with noise.

A thin lens moved to focus at a distance d has its image at f' = 1 / (1 / f - 1 / d); the focus
setting counts dioptres, so that f' grows with it. Distortion and centre drift smoothly.
"""

import numpy as np

from tagmetry.camera import BankNode, BrownLens, Camera, CameraBank, FisheyeLens
from tagmetry.geometry.arrays import Array

WIDTH_PX, HEIGHT_PX = 1280, 720
FOCAL_M, PITCH_M = 0.0045, 4.5e-6
NEAREST_DIOPTRES, LAST_FOCUS = 20.0, 150.0


def breathing(focus: float, zoom: float = 1.0, kind: str = "brown") -> Camera:
    """Return the exact camera at a focus."""
    share = focus / LAST_FOCUS
    image_m = 1 / (1 / FOCAL_M - share * NEAREST_DIOPTRES)
    focal_px = zoom * image_m / PITCH_M
    radial = -0.12 + 0.03 * share + 0.01 * share**2
    drift = (0.08 - 0.03 * share, 0.001, -0.0005, -0.02 + 0.01 * share)
    brown = BrownLens((radial, *drift))
    fisheye = FisheyeLens((0.02 + 0.02 * share, -0.01, 0.003 * share**2, 0.0))
    return Camera(
        WIDTH_PX,
        HEIGHT_PX,
        (focal_px, 1.001 * focal_px),
        (645 + 3 * share, 352 - 2 * share),
        brown if kind == "brown" else fisheye,
        zoom=zoom,
        focus=float(focus),
        name="webcam",
    )


def numbers(camera: Camera) -> Array:
    return np.array([*camera.focal_px, *camera.center_px, *camera.lens.coefficients])


def covariance_of(camera: Camera, sigma_px: float = 0.15) -> Array:
    """Return that of a calibration from corners over the whole image.

    The camera's rotation is not known better than 0.2 mrad: centre and tangential coefficients, as
    well as focal length and radial ones, come out as strongly correlated as from boards.
    """
    u, v = np.meshgrid(np.linspace(40, WIDTH_PX - 40, 12), np.linspace(40, HEIGHT_PX - 40, 8))
    rays = camera.unproject(np.stack([u, v], axis=-1).reshape(-1, 2))
    count = camera.parameter_count
    _, by_point = camera.project_with_jacobian(rays)
    turns = [np.einsum("nij,nj->ni", by_point, np.cross(axis, rays)) for axis in np.eye(3)]
    by_all = np.hstack(
        [camera.parameter_jacobian(rays).reshape(-1, count), np.stack(turns, -1).reshape(-1, 3)]
    )
    information = by_all.T @ by_all / sigma_px**2
    information[count:, count:] += np.eye(3) / 2e-4**2
    return np.linalg.inv(information)[:count, :count]


def changed(camera: Camera, values: Array, covariance: Array | None) -> Camera:
    fx, fy, cx, cy, *coefficients = (float(value) for value in values)
    lens = type(camera.lens)(tuple(coefficients))
    return Camera(
        *camera.size_px,
        (fx, fy),
        (cx, cy),
        lens,
        covariance,
        camera.zoom,
        camera.focus,
        camera.name,
    )


def measured(camera: Camera, rng: np.random.Generator, covariance: Array | None = None) -> Camera:
    """Return a calibration of the camera: off by noise of the covariance that it states."""
    covariance = covariance_of(camera) if covariance is None else covariance
    return changed(camera, rng.multivariate_normal(numbers(camera), covariance), covariance)


def exact_bank(step: float, kind: str = "brown", **options: bool) -> CameraBank:
    foci = np.arange(0.0, LAST_FOCUS + step / 2, step)
    return CameraBank(tuple(BankNode(breathing(focus, kind=kind)) for focus in foci), **options)


def pixels() -> Array:
    u, v = np.meshgrid(np.linspace(0, WIDTH_PX - 1, 9), np.linspace(0, HEIGHT_PX - 1, 6))
    return np.stack([u, v], axis=-1).reshape(-1, 2)


def error_px(found: Camera, truth: Camera) -> Array:
    """Return where rays of the true camera fall too far, shape (n, 2)."""
    return np.asarray(found.project(truth.unproject(pixels())) - pixels())


def same(found: Camera, expected: Camera, atol: float = 1e-9) -> None:
    np.testing.assert_allclose(numbers(found), numbers(expected), rtol=1e-12, atol=atol)
    assert found.size_px == expected.size_px
    assert (found.zoom, found.focus) == (expected.zoom, expected.focus)

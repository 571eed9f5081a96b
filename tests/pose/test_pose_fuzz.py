"""Whatever four points come in: nothing that is not a pose comes out."""

import numpy as np
import pytest
from seen_markers import DISTORTED, FACING, FISHEYE, PINHOLE

from tagmetry.camera import Camera
from tagmetry.geometry import Array
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import marker_corners_m
from tagmetry.pose.marker import solve

CHUNK = 500
CENTER = np.array(PINHOLE.center_px)
SQUARE = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])


def views(rng, camera: Camera, rotations: Rotation, low, high) -> Array:
    """Return projected markers of 0.1 m; NaN where the lens does not show them."""
    t = rng.uniform(low, high, (CHUNK, 3))
    return camera.project(
        marker_corners_m(np.full(CHUNK, 0.1)) @ np.swapaxes(rotations.as_matrix(), 1, 2)
        + t[:, None]
    )


def turned(rng, tilts_deg: Array, axis: str = "x") -> Rotation:
    return Rotation.from_euler(axis, tilts_deg, degrees=True) * FACING


def on_principal_lines(rng):
    tilts = rng.choice([-45.0, -30.0, -5.0, 0.0, 1e-6, 5.0, 30.0, 45.0], (CHUNK, 1))
    rotations = turned(rng, tilts, rng.choice(["x", "y"]))
    across = rng.choice([0.0, 0.3])
    quads = views(rng, PINHOLE, rotations, (-across, 0, 0.4), (across + 1e-300, 1e-300, 4.0))
    return quads if rng.random() < 0.5 else np.float64(np.float32(quads))


def fronto_parallel(rng):
    side = rng.choice([3.0, 8.0, 20.0, 100.0, 400.0], (CHUNK, 1, 1))
    return rng.choice([0.0, 50.0]) * rng.normal(size=(CHUNK, 1, 2)) + CENTER + SQUARE * side / 2


def tiny(rng):
    return (
        CENTER
        + rng.normal(size=(CHUNK, 1, 2)) * 200
        + 1.5 * SQUARE
        + rng.normal(size=(CHUNK, 4, 2)) * rng.choice([0.01, 0.1, 0.4])
    )


def collinear(rng):
    along = rng.uniform(-300, 300, (CHUNK, 4, 1)) * rng.normal(size=(CHUNK, 1, 2))
    return CENTER + along + rng.choice([0.0, 1e-12, 1e-6, 1e-3]) * rng.normal(size=(CHUNK, 4, 2))


def crossed(rng):
    return fronto_parallel(rng)[:, [0, 2, 1, 3]]


def reversed_order(rng):
    return fronto_parallel(rng)[:, ::-1]


def behind(rng):
    tilts = turned(rng, rng.uniform(-70, 70, (CHUNK, 1)))
    p = marker_corners_m(np.full(CHUNK, 0.1)) @ np.swapaxes(tilts.as_matrix(), 1, 2)
    p = p - np.array([0.0, 0.0, 1.0])
    return p[..., :2] / p[..., 2:] * 1000 + CENTER


def huge(rng):
    return SQUARE * 10.0 ** rng.uniform(4, 300, (CHUNK, 1, 1)) + rng.normal(size=(CHUNK, 4, 2))


def not_finite(rng):
    quads = fronto_parallel(rng)
    flat = quads.reshape(CHUNK, 8)
    flat[np.arange(CHUNK), rng.integers(8, size=CHUNK)] = rng.choice(
        [np.nan, np.inf, -np.inf], CHUNK
    )
    return quads


def duplicates(rng):
    quads = fronto_parallel(rng)
    quads[:, rng.integers(4)] = quads[:, rng.integers(4)] + rng.choice([0.0, 1e-9, 1e-3])
    return quads


def random_points(rng):
    return rng.uniform(-200, 1500, (CHUNK, 4, 2))


def random_views(rng):
    quads = views(rng, PINHOLE, Rotation.random(CHUNK, rng=rng), (-0.5, -0.4, 0.1), (0.5, 0.4, 5.0))
    return quads + rng.normal(size=(CHUNK, 4, 2)) * rng.choice([0.0, 0.1, 1.0])


def wide_fisheye(rng):
    quads = views(rng, FISHEYE, Rotation.random(CHUNK, rng=rng), (-2, -2, -0.3), (2, 2, 1.0))
    return quads + rng.normal(size=(CHUNK, 4, 2)) * 0.1


def distorted_edges(rng):
    return (
        rng.uniform(-100, 1400, (CHUNK, 1, 2))
        + rng.uniform(5, 60) * SQUARE
        + rng.normal(size=(CHUNK, 4, 2))
    )


KINDS = {
    **{k.__name__: (k, PINHOLE) for k in (on_principal_lines, fronto_parallel, tiny, collinear)},
    **{k.__name__: (k, PINHOLE) for k in (crossed, reversed_order, behind, huge, not_finite)},
    **{k.__name__: (k, PINHOLE) for k in (duplicates, random_points, random_views)},
    "huge_distorted": (huge, DISTORTED),
    "huge_fisheye": (huge, FISHEYE),
    "wide_fisheye": (wide_fisheye, FISHEYE),
    "distorted_edges": (distorted_edges, DISTORTED),
}
NEVER = {"crossed", "reversed_order", "not_finite"}
ALWAYS = {"on_principal_lines", "fronto_parallel"}


def check(kind: str, chunks: int) -> int:
    """Solve chunks of quadrilaterals, check every hypothesis, return how many had a pose."""
    make, camera = KINDS[kind]
    rng = np.random.default_rng(sorted(KINDS).index(kind))
    posed = 0
    for _ in range(chunks):
        quads = make(rng)
        noise = np.tile(np.eye(8) * rng.choice([1e-4, 0.01, 1.0]), (CHUNK, 1, 1))
        found = solve(quads, noise, np.full(CHUNK, 0.1), camera)
        assert len(found) == CHUNK
        check_all([h for h in found if h], is_pinhole=camera.lens.kind == "brown")
        posed += sum(map(bool, found))
    return posed


def check_all(found, is_pinhole: bool) -> None:
    if not found:
        return
    every = [h for hypotheses in found for h in hypotheses]
    R = np.stack([h.T_camera_marker.as_matrix()[:3, :3] for h in every])
    t = np.stack([h.T_camera_marker.translation for h in every])
    covariance = np.stack([h.covariance for h in every])
    assert np.isfinite(R).all()
    assert np.isfinite(t).all()
    assert np.isfinite(covariance).all()
    assert np.isfinite([[h.chi2, h.reprojection_rms_px, h.probability] for h in every]).all()
    np.testing.assert_allclose(
        R @ np.swapaxes(R, 1, 2), np.tile(np.eye(3), (len(R), 1, 1)), atol=1e-9
    )
    np.testing.assert_allclose(np.linalg.det(R), 1.0, atol=1e-9)
    assert ((R[:, :, 2] * t).sum(axis=1) < 0).all(), "the printed face looks at the camera"
    assert not is_pinhole or (t[:, 2] > 0).all()
    assert (np.einsum("nii->ni", covariance) >= 0).all()
    for hypotheses in found:
        shares = [h.probability for h in hypotheses]
        assert 1 <= len(shares) <= 2
        assert abs(sum(shares) - 1) < 1e-12
        assert shares == sorted(shares, reverse=True)


def check_kind(kind: str, chunks: int) -> None:
    posed = check(kind, chunks)
    assert not (kind in NEVER and posed)
    assert kind not in ALWAYS or posed == chunks * CHUNK


@pytest.mark.parametrize("kind", KINDS)
def test_ten_thousand_quadrilaterals_give_only_poses(kind):
    check_kind(kind, chunks=2)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_hundred_thousand_quadrilaterals_give_only_poses(kind):
    check_kind(kind, chunks=15)


@pytest.mark.parametrize("size_m", [1e-6, 1e-3, 1.0, 1e4])
def test_any_scale(size_m):
    quads = random_views(np.random.default_rng(5))
    noise = np.tile(np.eye(8) * 0.01, (CHUNK, 1, 1))
    found = solve(quads, noise, np.full(CHUNK, size_m), PINHOLE)
    check_all([h for h in found if h], is_pinhole=True)
    reference = solve(quads, noise, np.full(CHUNK, 0.1), PINHOLE)
    assert [len(h) for h in found] == [len(h) for h in reference]

"""The twin's lens and the camera model write one law twice: each is held against the other."""

import numpy as np
import pytest

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.twin.optics.rays import Rays

LENSES = {
    "none": BrownLens(),
    "4": BrownLens((-0.2, 0.05, 0.002, -0.003)),
    "5": BrownLens((-0.3, 0.1, 0.001, 0.002, -0.01)),
    "8": BrownLens((0.1, -0.02, 0.001, 0.002, 0.01, 0.02, -0.01, 0.003)),
    "12": BrownLens((-0.1, 0.02, 0.001, 0.002, 0.0, 0.0, 0.0, 0.0, 0.01, -0.02, 0.005, 0.01)),
    "14": BrownLens((-0.1, 0.02, *[0.001] * 10, 0.03, -0.02)),
    "fisheye": FisheyeLens((0.05, -0.02, 0.004, -0.001)),
}


def camera(lens: Lens) -> Camera:
    return Camera(640, 480, (500.0, 520.0), (310.0, 250.0), lens)


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
def test_sees_points_where_the_camera_model_projects_them(lens: Lens) -> None:
    rng = np.random.default_rng(0)
    p_camera = np.column_stack([rng.uniform(-0.5, 0.5, (200, 2)), rng.uniform(1, 2, 200)])
    seen = Rays(camera(lens)).see(p_camera)
    np.testing.assert_allclose(seen, camera(lens).project(p_camera), atol=1e-9)


@pytest.mark.parametrize("lens", LENSES.values(), ids=LENSES.keys())
def test_looks_where_it_sees(lens: Lens) -> None:
    u, v = np.meshgrid(np.linspace(-0.5, 639.5, 41), np.linspace(-0.5, 479.5, 31))
    rays = Rays(camera(lens))
    seen = rays.see(rays.look(u, v))
    np.testing.assert_allclose(seen, np.stack([u, v], axis=-1), atol=1e-8)


def test_fisheye_looks_past_ninety_degrees() -> None:
    wide = Camera(640, 480, (150.0, 150.0), (319.5, 239.5), FisheyeLens())
    directions = Rays(wide).look(np.array([0.0]), np.array([239.5]))
    assert np.arctan2(-directions[0, 0], directions[0, 2]) == pytest.approx(319.5 / 150.0)


def test_a_lens_that_folds_shows_nothing_beyond() -> None:
    folding = camera(BrownLens((-0.4, 0.0, 0.0, 0.0)))  # r (1 - 0.4 r^2) turns at r = 0.91
    u = np.array([310.0, 310.0 + 500 * 0.6, 310.0 + 500 * 0.62])
    rays = Rays(folding).look(u, np.full(3, 250.0))
    np.testing.assert_array_equal(np.isfinite(rays[:, 0]), [True, True, False])


def test_nothing_is_seen_behind_the_camera() -> None:
    assert np.isnan(Rays(camera(BrownLens())).see(np.array([[0.0, 0.0, -1.0]]))).all()

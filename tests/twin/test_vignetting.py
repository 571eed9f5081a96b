"""Corners darken by the law of their angle, and by nothing else."""

import numpy as np
import pytest

from tagmetry.camera import BrownLens, Camera, FisheyeLens, zoomed
from tagmetry.errors import InputError
from tagmetry.twin.optics.vignetting import Vignetting, gain_map, vignetted

CAMERA = Camera(64, 48, (40.0, 42.0), (30.0, 25.0))
LIGHT = np.random.default_rng(0).random((48, 64), dtype=np.float32)


def test_cos4_of_a_pinhole_is_the_law_in_the_image_plane() -> None:
    """cos^4 a = 1 / (1 + tan^2 a)^2."""
    u, v = np.meshgrid(np.arange(64), np.arange(48))
    tan2 = ((u - 30.0) / 40.0) ** 2 + ((v - 25.0) / 42.0) ** 2
    gain = gain_map(CAMERA, Vignetting(cos4=1.0))
    assert gain.dtype == np.float32
    np.testing.assert_allclose(gain, 1 / (1 + tan2) ** 2, rtol=1e-6)
    half = gain_map(CAMERA, Vignetting(cos4=0.5))
    np.testing.assert_allclose(half, (1 + 1 / (1 + tan2) ** 2) / 2, rtol=1e-6)


def test_cos4_of_a_fisheye_goes_by_its_angle() -> None:
    """An equidistant fisheye: the angle is the radius; no light comes from behind."""
    camera = Camera(101, 101, (30.0, 30.0), (50.0, 50.0), FisheyeLens((0.0, 0.0, 0.0, 0.0)))
    gain = gain_map(camera, Vignetting(cos4=1.0))
    angles_rad = (np.arange(101) - 50) / 30
    expected = np.where(np.abs(angles_rad) < np.pi / 2, np.cos(angles_rad) ** 4, 0.0)
    np.testing.assert_allclose(gain[50], expected, atol=1e-6)


def test_cos4_of_a_distorted_lens_goes_by_the_ray() -> None:
    camera = Camera(64, 48, (60.0, 60.0), (31.5, 23.5), BrownLens((-0.2, 0.05, 0.0, 0.0)))
    pixels = np.array([[0.0, 0.0], [50.0, 10.0], [31.0, 24.0]])
    rays = camera.unproject(pixels)  # unit vectors
    gain = gain_map(camera, Vignetting(cos4=1.0))
    seen = gain[pixels[:, 1].astype(int), pixels[:, 0].astype(int)]
    np.testing.assert_allclose(seen, rays[:, 2] ** 4, rtol=1e-6)


def test_a_polynomial_goes_by_the_radius() -> None:
    gain = gain_map(CAMERA, Vignetting(radial=(-0.3, 0.05)))
    assert gain[25, 30] == 1.0
    assert gain[25, 64 - 1] == pytest.approx(1 - 0.3 * (33 / 40) ** 2 + 0.05 * (33 / 40) ** 4)
    both = gain_map(CAMERA, Vignetting(1.0, (-0.3, 0.05)))
    natural = gain_map(CAMERA, Vignetting(1.0))
    np.testing.assert_allclose(both, natural * gain, rtol=1e-6)


def test_a_digital_zoom_sees_the_same_fall_of_light() -> None:
    law = Vignetting(0.7, (-0.1,))
    near, whole = gain_map(zoomed(CAMERA, 3.0), law), gain_map(CAMERA, law)
    for u, v in ((22, 16), (31, 23), (40, 30)):  # u' = 31.5 + 3 (u - 31.5), v' = 23.5 + ...
        assert near[3 * v - 47, 3 * u - 63] == pytest.approx(whole[v, u], rel=1e-6)


def test_light_is_multiplied_and_none_is_lost_without_vignetting() -> None:
    law = Vignetting(0.5)
    np.testing.assert_array_equal(vignetted(LIGHT, CAMERA, law), LIGHT * gain_map(CAMERA, law))
    assert vignetted(LIGHT, CAMERA, Vignetting()) is LIGHT


def test_a_large_image_has_the_same_law() -> None:
    camera = Camera(1280, 720, (900.0, 880.0), (630.2, 371.0))
    gain = gain_map(camera, Vignetting(0.8, (-0.1,)))
    u, v = np.meshgrid(np.arange(1280), np.arange(720))
    q = ((u - 630.2) / 900.0) ** 2 + ((v - 371.0) / 880.0) ** 2
    expected = (0.2 + 0.8 / (1 + q) ** 2) * (1 - 0.1 * q)
    np.testing.assert_allclose(gain, expected, atol=3e-5)


def test_the_map_is_kept_and_cannot_be_changed() -> None:
    law = Vignetting(0.5)
    assert gain_map(CAMERA, law) is gain_map(CAMERA, Vignetting(0.5))
    with pytest.raises(ValueError, match="read-only"):
        gain_map(CAMERA, law)[0, 0] = 1.0


def test_there_is_no_light_where_the_lens_shows_nothing_and_never_less_than_none() -> None:
    folded = Camera(64, 48, (20.0, 20.0), (31.5, 23.5), BrownLens((-0.6, 0.0, 0.0, 0.0)))
    gain = gain_map(folded, Vignetting(1.0))
    assert gain[0, 0] == 0.0
    assert gain[24, 32] == pytest.approx(1.0, abs=0.01)
    assert gain_map(CAMERA, Vignetting(radial=(-5.0,))).min() == 0.0


def test_refuses_what_is_no_law_and_no_image_of_the_camera() -> None:
    with pytest.raises(InputError, match=r"strength of the cos\^4 law is 0 to 1, got 1.5"):
        Vignetting(1.5)
    with pytest.raises(InputError, match="radial coefficients must be finite"):
        Vignetting(radial=(float("nan"),))
    with pytest.raises(InputError, match="intrinsics belong to 64x48"):
        vignetted(LIGHT[:10], CAMERA, Vignetting(0.5))

"""The bank at other zooms and image sizes than those that were calibrated."""

from dataclasses import replace

import numpy as np
import pytest
from bank_cameras import (
    HEIGHT_PX,
    WIDTH_PX,
    breathing,
    error_px,
    exact_bank,
    measured,
    numbers,
    pixels,
    same,
)

from tagmetry.camera import (
    BankNode,
    CameraBank,
    cropped,
    scaled,
    zoomed,
)
from tagmetry.errors import InputError


@pytest.mark.parametrize("reference", [1.0, 100.0])
def test_digital_zoom_is_that_of_the_image(reference: float) -> None:
    """A zoomed image shows a ray where the pixel of the reference went, and only once."""
    nodes = tuple(BankNode(replace(breathing(f), zoom=reference)) for f in (0, 15, 30, 45))
    bank = CameraBank(nodes, zoom_is_digital=True)
    plain = bank.camera_at(focus=20)
    found = bank.camera_at(focus=20, zoom=3.2 * reference)
    middle = np.array([(WIDTH_PX - 1) / 2, (HEIGHT_PX - 1) / 2])
    inside = pixels() * 0.2 + 0.4 * np.array([WIDTH_PX - 1, HEIGHT_PX - 1])
    rays = plain.unproject(inside)
    np.testing.assert_allclose(found.project(rays), middle + 3.2 * (inside - middle), atol=1e-9)
    assert found.focal_px[0] == pytest.approx(3.2 * plain.focal_px[0], rel=1e-14)
    assert found.zoom == 3.2 * reference
    same(bank.camera_at(focus=20, zoom=reference), plain)


def test_depth_through_a_digital_zoom_is_real() -> None:
    """A 10 mm marker at 1 m: its size in the zoomed image gives 1 m without equation 8."""
    bank = exact_bank(15, zoom_is_digital=True)
    camera = bank.camera_at(focus=33, zoom=5.0)
    ends = camera.project(np.array([[-0.005, 0.0, 1.0], [0.005, 0.0, 1.0]]))
    seen_px = (
        5.0
        * np.ptp(
            bank.camera_at(focus=33).project(np.array([[-0.005, 0, 1], [0.005, 0, 1]])), axis=0
        )[0]
    )
    assert np.ptp(ends, axis=0)[0] == pytest.approx(seen_px, rel=1e-12)
    assert camera.focal_px[0] * 0.01 / seen_px == pytest.approx(1.0, rel=1e-3)


def test_covariance_follows_the_digital_zoom() -> None:
    rng = np.random.default_rng(0)
    nodes = tuple(BankNode(measured(breathing(focus), rng)) for focus in (0, 15, 30))
    bank = CameraBank(nodes, zoom_is_digital=True)
    found = bank.camera_at(focus=20, zoom=4.0)
    expected = zoomed(bank.camera_at(focus=20), 4.0)
    np.testing.assert_allclose(found.covariance, expected.covariance, rtol=1e-12)


def test_optical_zoom_is_interpolated_over_its_own_calibrations() -> None:
    zooms, foci = (1.0, 1.5, 2.0, 2.5, 3.0), (0.0, 30.0, 60.0, 90.0)
    nodes = tuple(BankNode(breathing(focus, zoom)) for zoom in zooms for focus in foci)
    bank = CameraBank(nodes)
    found = bank.camera_at(focus=40, zoom=1.8)
    assert np.abs(error_px(found, breathing(40, 1.8))).max() < 2.0
    assert found.focal_px[0] == pytest.approx(breathing(40, 1.8).focal_px[0], rel=3e-3)
    assert (found.zoom, found.focus) == (1.8, 40)
    assert np.abs(error_px(bank.camera_at(focus=40, zoom=2.0), breathing(40, 2.0))).max() < 0.02
    with pytest.raises(InputError, match=r"zoom 3.1 lies outside 1 to 3"):
        bank.camera_at(focus=40, zoom=3.1)
    with pytest.raises(InputError, match="say at which zoom: the bank has 1 to 3"):
        bank.camera_at(focus=40)


def test_refuses_a_zoom_that_nobody_calibrated() -> None:
    with pytest.raises(InputError, match=r"zoom 2 .* only 1; calibrate at others too, or say that"):
        exact_bank(15).camera_at(focus=20, zoom=2.0)


@pytest.mark.parametrize("zoom", [0.5, float("nan"), float("inf")])
def test_refuses_a_digital_zoom_below_its_reference(zoom: float) -> None:
    with pytest.raises(InputError, match=r"digital zoom of .* the calibrations are at 1"):
        exact_bank(15, zoom_is_digital=True).camera_at(focus=20, zoom=zoom)


def test_another_size_is_scaled_where_that_is_allowed() -> None:
    bank = exact_bank(15, may_scale=True)
    found = bank.camera_at(focus=20, width_px=640, height_px=360)
    same(found, scaled(bank.camera_at(focus=20), 640, 360))
    rays = breathing(20).unproject(pixels())
    expected = (breathing(20).project(rays) + 0.5) / 2 - 0.5
    np.testing.assert_allclose(found.project(rays), expected, atol=1e-3)


def test_refuses_another_size_otherwise() -> None:
    with pytest.raises(
        InputError, match=r"no calibration for 640x360 .*not allow.*there are 1280x720"
    ):
        exact_bank(15).camera_at(focus=20, width_px=640, height_px=360)
    with pytest.raises(InputError, match="no calibration for 640x480 images of that shape"):
        exact_bank(15, may_scale=True).camera_at(focus=20, width_px=640, height_px=480)


def test_each_size_has_its_own_calibrations() -> None:
    small = [replace(cropped(breathing(focus), 320, 180, 640, 360)) for focus in (0, 30)]
    bank = CameraBank((*exact_bank(15).nodes, *map(BankNode, small)), may_scale=True)
    assert bank.sizes_px == ((1280, 720), (640, 360))
    found = bank.camera_at(focus=30, width_px=640, height_px=360)
    np.testing.assert_array_equal(numbers(found), numbers(small[1]))
    with pytest.raises(
        InputError, match="say for which image size: the bank has 1280x720, 640x360"
    ):
        bank.camera_at(focus=30)

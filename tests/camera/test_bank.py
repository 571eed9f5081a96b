"""The bank between its calibrations, against a lens whose law is known at any focus."""

from dataclasses import replace

import numpy as np
import pytest
from bank_cameras import (
    HEIGHT_PX,
    WIDTH_PX,
    breathing,
    changed,
    covariance_of,
    error_px,
    exact_bank,
    measured,
    numbers,
    pixels,
)
from scipy.interpolate import PchipInterpolator

from tagmetry.camera import (
    BankNode,
    BrownLens,
    Camera,
    CameraBank,
    FisheyeLens,
    Lens,
    scaled,
)
from tagmetry.camera.bank.between import re_expressed
from tagmetry.errors import InputError

SIZE = {"width_px": WIDTH_PX, "height_px": HEIGHT_PX}


@pytest.mark.parametrize("kind", ["brown", "fisheye"])
@pytest.mark.parametrize(("step", "bound_px"), [(5, 2e-4), (15, 2e-3), (30, 2e-2)])
def test_follows_the_law_between_calibrations(kind: str, step: float, bound_px: float) -> None:
    bank = exact_bank(step, kind)
    for focus in (1.7, 52.5, 83.1, 148.9):
        found, truth = bank.camera_at(focus=focus), breathing(focus, kind=kind)
        assert np.abs(error_px(found, truth)).max() < bound_px
        assert found.focus == focus
        assert found.name == "webcam"


def test_is_the_calibration_itself_at_a_node() -> None:
    camera = measured(breathing(35), np.random.default_rng(0))
    bank = exact_bank(5).drop(focus=35).with_node(camera)
    found = bank.camera_at(focus=35.0, zoom=1.0, **SIZE)
    np.testing.assert_array_equal(numbers(found), numbers(camera))
    np.testing.assert_array_equal(found.covariance, camera.covariance)


def test_is_continuous_at_a_node() -> None:
    rng = np.random.default_rng(0)
    foci = (0, 20, 40, 60)
    bank = CameraBank(tuple(BankNode(measured(breathing(focus), rng)) for focus in foci))
    at, beside = bank.camera_at(focus=20), bank.camera_at(focus=20 + 1e-9)
    assert np.abs(error_px(beside, at)).max() < 1e-6
    np.testing.assert_allclose(beside.covariance, at.covariance, rtol=1e-4, atol=1e-12)


def test_order_of_the_nodes_does_not_matter() -> None:
    bank = exact_bank(15)
    turned = CameraBank(bank.nodes[::-1])
    np.testing.assert_array_equal(
        numbers(turned.camera_at(focus=20)), numbers(bank.camera_at(focus=20))
    )


def test_two_calibrations_are_joined_by_a_straight_line() -> None:
    bank = CameraBank((BankNode(breathing(30)), BankNode(breathing(60))))
    rays = [breathing(focus).unproject(pixels()) for focus in (30, 60)]
    expected = np.mean([ray[..., :2] / (1 + ray[..., 2:]) for ray in rays], axis=0)
    found = bank.camera_at(focus=45).unproject(pixels())
    np.testing.assert_allclose(found[..., :2] / (1 + found[..., 2:]), expected, atol=1e-6)


def refitted(focus: float, rng: np.random.Generator) -> Camera:
    """Return the rational model fitted to a grid of noisy pixels from a start of its own."""
    from scipy.optimize import least_squares

    truth = breathing(focus)
    rays = truth.unproject(pixels())
    seen = pixels() + rng.normal(0, 0.05, pixels().shape)
    start = np.array([*numbers(truth)[:4], *rng.normal(0, 0.3, 2), 0, 0, *rng.normal(0, 0.2, 4)])
    template = replace(truth, lens=BrownLens((0.0,) * 8))

    def residual(values: np.ndarray) -> np.ndarray:
        shown = changed(template, values, None).project(rays) - seen
        return np.nan_to_num(shown.ravel(), nan=100.0)

    found = least_squares(residual, start, x_scale="jac", max_nfev=80).x
    return changed(template, found, None)


def test_rays_blend_where_coefficients_do_not() -> None:
    """Rational lenses that bend alike have coefficients far apart: their mean is another lens."""
    rng = np.random.default_rng(1)
    foci = np.arange(0.0, 101.0, 25.0)
    cameras = [refitted(focus, rng) for focus in foci]
    bank = CameraBank(tuple(map(BankNode, cameras)))
    by_coefficients = PchipInterpolator(foci, [numbers(camera) for camera in cameras])
    rays_px, coefficients_px = [], []
    for focus in foci[:-1] + 12.5:
        truth = breathing(focus)
        blended = changed(cameras[0], by_coefficients(focus), None)
        rays_px.append(np.nanmax(np.abs(error_px(bank.camera_at(focus=focus), truth))))
        coefficients_px.append(np.nanmax(np.abs(error_px(blended, truth))))
    assert np.median(rays_px) < 0.1
    assert max(rays_px) < 0.2
    assert np.median(coefficients_px) > 1.0
    assert max(coefficients_px) > 5.0


def test_a_lens_is_expressed_near_other_coefficients() -> None:
    rng = np.random.default_rng(1)
    cameras = [refitted(focus, rng) for focus in (0.0, 25.0, 50.0)]
    for like in cameras[1:]:
        found = re_expressed(cameras[0], like)
        assert np.sqrt(np.mean(error_px(found, cameras[0]) ** 2)) < 0.05


def test_five_coefficients_blend_as_well_as_rays() -> None:
    """The image is linear in them, so nothing is lost: rays are for the models where it is not."""
    rng = np.random.default_rng(2)
    foci = np.arange(0.0, 151.0, 10.0)
    cameras = [replace(measured(breathing(focus), rng), covariance=None) for focus in foci]
    bank = CameraBank(tuple(map(BankNode, cameras)))
    by_coefficients = PchipInterpolator(foci, [numbers(camera) for camera in cameras])
    squares = np.zeros(2)
    for focus in foci[:-1] + 5.0:
        truth = breathing(focus)
        blended = changed(cameras[0], by_coefficients(focus), None)
        both = (bank.camera_at(focus=focus), blended)
        squares += [np.mean(error_px(camera, truth) ** 2) for camera in both]
    assert np.sqrt(squares[0] / squares[1]) == pytest.approx(1.0, abs=0.1)


def test_calibrations_with_different_counts_of_coefficients_go_together() -> None:
    fewer = replace(breathing(30), lens=BrownLens((-0.1, 0.02, 0.0, 0.0)), covariance=np.eye(8))
    more = replace(breathing(60), lens=BrownLens((-0.1, 0.02, 0.0, 0.0, 0.0)), covariance=np.eye(9))
    bank = CameraBank((BankNode(fewer), BankNode(more)))
    found = bank.camera_at(focus=45)
    np.testing.assert_allclose(found.lens.coefficients, more.lens.coefficients, atol=1e-4)
    assert found.covariance is not None
    assert len(bank.camera_at(focus=30).lens.coefficients) == 5


def test_a_camera_without_covariance_leaves_its_neighbours_without() -> None:
    rng = np.random.default_rng(0)
    nodes = [measured(breathing(focus), rng) for focus in (0, 10, 20, 30, 40, 50)]
    bank = CameraBank(tuple(map(BankNode, [replace(nodes[0], covariance=None), *nodes[1:]])))
    assert bank.camera_at(focus=5).covariance is None
    assert bank.camera_at(focus=45).covariance is not None


@pytest.mark.parametrize("focus", [-0.1, 150.1, float("nan")])
def test_refuses_to_extrapolate(focus: float) -> None:
    with pytest.raises(InputError, match=r"focus .* lies outside 0 to 150, where the bank has"):
        exact_bank(15).camera_at(focus=focus)


def test_the_range_is_that_of_the_zoom_and_size_asked_for() -> None:
    bank = exact_bank(15).with_node(scaled(breathing(10), 640, 360))
    with pytest.raises(InputError, match="focus 20 lies outside 10 to 10"):
        bank.camera_at(focus=20, width_px=640, height_px=360)


# Holes


def test_a_bank_with_holes_works_and_names_them() -> None:
    bank = exact_bank(5)
    assert bank.gaps(5) == ()
    holed = bank.drop(focus=40).drop(focus=45).drop(focus=100)
    gaps = [(gap.zoom, gap.low_focus, gap.high_focus) for gap in holed.gaps(5)]
    assert gaps == [(1.0, 35.0, 50.0), (1.0, 95.0, 105.0)]
    assert [gap.low_focus for gap in holed.gaps(10)] == [35.0]
    assert np.abs(error_px(holed.camera_at(focus=42), breathing(42))).max() < 3e-3
    filled = holed.with_node(breathing(40))
    assert [gap.low_focus for gap in filled.gaps(5)] == [40.0, 95.0]


@pytest.mark.parametrize("step", [0.0, -1.0, float("nan")])
def test_refuses_a_step_that_is_none(step: float) -> None:
    with pytest.raises(InputError, match="step of the focus must be positive"):
        exact_bank(30).gaps(step)


def test_refuses_to_drop_what_is_not_there() -> None:
    with pytest.raises(InputError, match="no calibration at focus 41, zoom None"):
        exact_bank(5).drop(focus=41)
    with pytest.raises(InputError, match="needs at least one calibration"):
        exact_bank(5).drop()


# What cannot be a bank


def node(
    lens: Lens, focus: float | None = 0.0, name: str = "webcam", zoom: float = 1.0
) -> BankNode:
    camera = Camera(640, 480, (500.0, 500.0), (320.0, 240.0), lens, focus=focus, name=name)
    return BankNode(replace(camera, zoom=zoom))


def test_refuses_what_is_no_bank() -> None:
    with pytest.raises(InputError, match="at least one calibration, found none"):
        CameraBank(())
    with pytest.raises(InputError, match="needs the focus that it was made at, found None"):
        node(BrownLens(), None)
    with pytest.raises(InputError, match="found calibrations of 'other', 'webcam'"):
        CameraBank((node(BrownLens()), node(BrownLens(), name="other")))
    with pytest.raises(InputError, match="one lens model, found brown and fisheye"):
        CameraBank((node(BrownLens()), node(FisheyeLens(), 1.0)))
    with pytest.raises(InputError, match="one zoom, found 1, 2; keep those at the smallest"):
        CameraBank((node(BrownLens()), node(BrownLens(), zoom=2.0)), zoom_is_digital=True)
    with pytest.raises(InputError, match="approach must be"):
        BankNode(breathing(0), "sideways")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="focus 0: the covariance must be finite"):
        BankNode(replace(breathing(0), covariance=np.full((9, 9), np.inf)))


def test_refuses_a_distortion_that_folds_everywhere() -> None:
    folded = [replace(breathing(focus), lens=BrownLens((-1e9, 0.0, 0.0, 0.0))) for focus in (0, 10)]
    with pytest.raises(InputError, match="at focus 0, 10 folds over nearly the whole image"):
        CameraBank(tuple(map(BankNode, folded))).camera_at(focus=5)


def test_the_smallest_image_does_no_harm() -> None:
    tiny = [replace(breathing(focus), width_px=1, height_px=1) for focus in (0, 10, 20)]
    bank = CameraBank(tuple(BankNode(replace(c, covariance=covariance_of(c))) for c in tiny))
    found = bank.camera_at(focus=5)
    assert np.isfinite(numbers(found)).all()
    assert np.isfinite(np.asarray(found.covariance)).all()

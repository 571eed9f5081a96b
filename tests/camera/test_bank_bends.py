"""The doubt of interpolating is where the camera bends, in banks of 31 calibrations down to two."""

from dataclasses import replace

import numpy as np
import pytest
from bank_cameras import breathing, changed, covariance_of, error_px, measured, numbers, pixels
from scipy.stats import chi2

from tagmetry.camera import BankNode, Camera, CameraBank
from tagmetry.camera.bank.parameters import mean_variance_px2

_LAST = 150.0


def webcam_at(focus: float) -> Camera:
    """Return seed 000's camera: a thin lens whose sharp depth is exp((4 - F) / 42.11) metres."""
    sharp_m = np.exp((4.0 - focus) / 42.11)
    image_m = 1 / (1 / 0.0045 - 1 / sharp_m)
    values = numbers(breathing(0))
    values[:2] = image_m / 4.5e-6
    return replace(changed(breathing(0), values, None), focus=float(focus))


def bank_of(foci: np.ndarray, rng: np.random.Generator, sigma_px: float = 0.05) -> CameraBank:
    cameras = [
        measured(webcam_at(focus), rng, covariance_of(webcam_at(focus), sigma_px)) for focus in foci
    ]
    return CameraBank(tuple(map(BankNode, cameras)))


def share_inside(bank: CameraBank, focus: float) -> float:
    """Return the share of the pixels within their stated region of 95 %."""
    camera, truth = bank.camera_at(focus=focus), webcam_at(focus)
    J = camera.parameter_jacobian(truth.unproject(pixels()))
    spread = J @ np.asarray(camera.covariance) @ J.swapaxes(-1, -2)
    error = error_px(camera, truth)
    squares = np.einsum("ni,nij,nj->n", error, np.linalg.inv(spread), error)
    return float((squares < chi2.ppf(0.95, 2)).mean())


def focal_error_and_sd(bank: CameraBank, focus: float) -> tuple[float, float]:
    camera = bank.camera_at(focus=focus)
    error = camera.focal_px[0] - webcam_at(focus).focal_px[0]
    return error, float(np.sqrt(np.asarray(camera.covariance)[0, 0]))


@pytest.mark.parametrize("count", [pytest.param(31, marks=pytest.mark.slow), 16, 11])
def test_all_half_and_a_third_of_the_calibrations_cover_the_truth(count: int) -> None:
    """The last gap, where the focal length bends most, is asked as often as all others."""
    rng = np.random.default_rng(11)
    foci = np.linspace(0.0, _LAST, count)
    step = foci[1]
    found, last = [], []
    for _ in range(8):
        bank = bank_of(foci, rng)
        asked = rng.choice(foci[:-2], 2, replace=False) + rng.choice([0.3, 0.5], 2) * step
        found.extend(share_inside(bank, focus) for focus in asked)
        last.append(share_inside(bank, _LAST - 0.5 * step))
    assert np.mean(found) >= 0.85
    assert np.mean(last) >= 0.85


@pytest.mark.parametrize("count", [4, 6, 11])
def test_the_doubt_is_greatest_where_the_camera_bends_most(count: int) -> None:
    """Without noise: the error of the last gap is held, and the first ones do not pay for it."""
    foci = np.linspace(0.0, _LAST, count)
    exact = [
        replace(webcam_at(focus), covariance=covariance_of(webcam_at(focus), 1e-3))
        for focus in foci
    ]
    bank = CameraBank(tuple(map(BankNode, exact)))
    asked = (foci[:-1] + foci[1:]) / 2
    errors, deviations = np.array([focal_error_and_sd(bank, focus) for focus in asked]).T
    assert (np.abs(errors) < 1.96 * deviations).all()
    assert deviations[-1] < 3 * abs(errors[-1])
    assert deviations[0] < 0.2 * deviations[-1]


def test_two_calibrations_hold_any_law_that_only_rises() -> None:
    """The bank is 4 % off half way and says so; at the two themselves nothing is added."""
    bank = bank_of(np.array([0.0, _LAST]), np.random.default_rng(2))
    error, deviation = focal_error_and_sd(bank, 75.0)
    assert abs(error) > 0.03 * bank.nodes[0].camera.focal_px[0]
    assert abs(error) < 1.96 * deviation
    assert share_inside(bank, 75.0) > 0.9
    (gap,) = bank.gaps(5)
    focal_px = bank.camera_at(focus=75.0).focal_px[0]
    assert gap.focal_sd_percent == pytest.approx(100 * deviation / focal_px)
    near = np.asarray(bank.camera_at(focus=1e-4).covariance)
    own = np.asarray(bank.camera_at(focus=0.0).covariance)
    np.testing.assert_allclose(np.diag(near), np.diag(own), rtol=1e-3)


def test_two_calibrations_that_differ_by_noise_only_are_hardly_doubted() -> None:
    rng = np.random.default_rng(4)
    covariance = covariance_of(webcam_at(0))
    ratios = []
    for _ in range(40):
        pair = [replace(measured(webcam_at(0), rng, covariance), focus=at) for at in (0.0, 10.0)]
        bank = CameraBank(tuple(map(BankNode, pair)))
        ratios.append(mean_variance_px2(bank.camera_at(focus=5.0)) / mean_variance_px2(pair[0]))
    assert np.min(ratios) > 0.49
    assert np.mean(ratios) < 0.75


def test_two_without_covariance_say_that_nothing_is_known() -> None:
    bank = CameraBank(tuple(BankNode(webcam_at(focus)) for focus in (0.0, _LAST)))
    assert bank.camera_at(focus=75.0).covariance is None
    assert bank.gaps(5)[0].focal_sd_percent is None

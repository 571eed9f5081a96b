"""What a bank says of its own accuracy: covariance, leave-one-out, repeated calibrations."""

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
from scipy.stats import chi2

from tagmetry.camera import BankNode, BrownLens, CameraBank
from tagmetry.camera.bank.between import camera_between
from tagmetry.camera.bank.parameters import mean_variance_px2
from tagmetry.geometry.arrays import Array


def noisy_bank(foci: Array, covariances: list[Array], rng: np.random.Generator) -> CameraBank:
    cameras = [
        measured(breathing(focus), rng, covariance)
        for focus, covariance in zip(foci, covariances, strict=True)
    ]
    return CameraBank(tuple(map(BankNode, cameras)))


def squared_distances(bank: CameraBank, focus: float) -> tuple[Array, float]:
    """Return Mahalanobis distances squared of the pixels, shape (n,), and of all parameters."""
    camera, truth = bank.camera_at(focus=focus), breathing(focus)
    by_parameters = camera.parameter_jacobian(truth.unproject(pixels()))
    spread = by_parameters @ np.asarray(camera.covariance) @ by_parameters.swapaxes(-1, -2)
    error = error_px(camera, truth)
    distance = np.einsum("ni,nij,nj->n", error, np.linalg.inv(spread), error)
    off = numbers(camera) - numbers(truth)
    return distance, float(off @ np.linalg.solve(np.asarray(camera.covariance), off))


@pytest.mark.parametrize(
    ("step", "trials", "foci_each"),
    [
        pytest.param(5.0, 60, 15, marks=pytest.mark.slow),
        (15.0, 12, 4),
        pytest.param(15.0, 200, 5, marks=pytest.mark.slow),
        pytest.param(30.0, 200, 4, marks=pytest.mark.slow),
    ],
)
def test_the_stated_region_holds_the_truth(step: float, trials: int, foci_each: int) -> None:
    """31 calibrations as in seed 000, and fewer; foci at, near and midway between them.

    The foci of one trial share calibrations, so the trials are what is counted. Bounds are three
    standard deviations of a mean over them, and 2 % for what is second order. Of 1 000 foci 15
    steps apart 95.6 % (pixels) and 95.3 % (parameters) were inside.
    """
    rng = np.random.default_rng(5)
    foci = np.arange(0.0, 151.0, step)
    covariances = [covariance_of(breathing(focus)) for focus in foci]
    found = []
    for _ in range(trials):
        bank = noisy_bank(foci, covariances, rng)
        low = rng.choice(foci[:-1], foci_each, replace=False)
        asked = low + step * rng.choice([0.2, 0.5, 0.9], foci_each)
        found.append(np.mean([shares(*squared_distances(bank, focus)) for focus in asked], axis=0))
    mean, margin = np.mean(found, axis=0), 0.02 + 3 * np.array(_TRIAL_SD) / np.sqrt(trials)
    expected = np.array([0.95, 0.95, 1.0, 1.0])
    assert (np.abs(mean - expected) < margin).all(), (mean, margin)


_TRIAL_SD = (0.1, 0.11, 0.5, 0.3)  # of one trial's means, as measured over 40 to 200 trials


def shares(pixel_squares: Array, all_squares: float) -> tuple[float, float, float, float]:
    """Return the shares inside of the 95 % regions and the mean squares per degree of freedom."""
    inside = float((pixel_squares < chi2.ppf(0.95, 2)).mean())
    whole = float(all_squares < chi2.ppf(0.95, 9))
    return inside, whole, float(pixel_squares.mean() / 2), all_squares / 9


def sharply_bent(focus: float) -> tuple[float, float]:
    """Return the focal length and k1 of a lens whose law no few calibrations follow."""
    return 1000 + 40 * np.sin(focus / 14), -0.1 + 0.01 * np.cos(focus / 11)


def test_the_error_of_interpolating_is_in_the_covariance() -> None:
    """Calibrations of 0.01 px, a law that needs more of them: the region is the interpolation's."""
    covariance = covariance_of(breathing(0), sigma_px=0.01)

    def truth_at(focus: float) -> Array:
        focal_px, k1 = sharply_bent(focus)
        return np.array([focal_px, focal_px, 645, 352, k1, 0.05, 0, 0, 0])

    foci = np.arange(0.0, 151.0, 10.0)
    cameras = [changed(breathing(focus), truth_at(focus), covariance) for focus in foci]
    bank = CameraBank(tuple(map(BankNode, cameras)))
    ratios = []
    for focus in foci[1:-2] + 5.0:
        camera = bank.camera_at(focus=focus)
        truth = changed(camera, truth_at(focus), None)
        by_parameters = camera.parameter_jacobian(truth.unproject(pixels()))
        spread = by_parameters @ np.asarray(camera.covariance) @ by_parameters.swapaxes(-1, -2)
        variance = np.trace(spread, axis1=-2, axis2=-1).mean()
        ratios.append((error_px(camera, truth) ** 2).sum(axis=-1).mean() / variance)
    assert 0.1 < np.mean(ratios) < 2.0
    near = bank.camera_at(focus=60.001).covariance
    np.testing.assert_allclose(np.diag(near), np.diag(covariance), rtol=0.1)


def test_noise_alone_is_not_taken_for_an_error_of_interpolating() -> None:
    rng = np.random.default_rng(3)
    foci = np.arange(0.0, 151.0, 5.0)
    bank = noisy_bank(foci, [covariance_of(breathing(focus)) for focus in foci], rng)
    cameras = [node.camera for node in bank.nodes]
    plain = mean_variance_px2(camera_between(cameras, foci, 72.5))
    assert 1.0 <= mean_variance_px2(bank.camera_at(focus=72.5)) / plain < 1.06
    assert 0.3 < plain / mean_variance_px2(cameras[15]) < 1.0


def test_leaving_one_out_finds_the_bad_one() -> None:
    exact = exact_bank(10)
    assert max(row.worst_px for row in exact.leave_one_out()) < 5e-3
    bad = replace(breathing(70), focal_px=tuple(1.01 * f for f in breathing(70).focal_px))
    rows = exact.drop(focus=70).with_node(bad).leave_one_out()
    assert [row.focus for row in rows] == list(np.arange(10.0, 141.0, 10.0))
    worst = max(rows, key=lambda row: row.worst_px)
    assert (worst.focus, worst.zoom, worst.width_px, worst.height_px) == (70, 1, 1280, 720)
    assert worst.focal_percent == pytest.approx(-1.0, abs=0.02)
    assert worst.center_px < 0.1
    corner_px = 0.01 * np.hypot(WIDTH_PX - 645 - 0.5, HEIGHT_PX - 352 - 0.5)
    assert worst.worst_px == pytest.approx(corner_px, rel=0.05)


def test_leaving_one_out_is_what_dropping_it_gives() -> None:
    rng = np.random.default_rng(4)
    foci = np.arange(0.0, 61.0, 10.0)
    bank = noisy_bank(foci, [covariance_of(breathing(focus)) for focus in foci], rng)
    for row in bank.leave_one_out():
        kept = next(node.camera for node in bank.nodes if node.focus == row.focus)
        predicted = bank.drop(focus=row.focus).camera_at(focus=row.focus)
        ratio = np.mean(np.array(predicted.focal_px) / kept.focal_px)
        assert row.focal_percent == pytest.approx(100 * (ratio - 1), abs=1e-9)
        moved = np.array(predicted.center_px) - kept.center_px
        assert row.center_px == pytest.approx(np.hypot(*moved), abs=1e-9)
        assert row.worst_px >= np.linalg.norm(error_px(predicted, kept), axis=-1).max() - 1e-9


def test_a_bank_too_small_to_leave_one_out_says_nothing() -> None:
    bank = CameraBank(tuple(BankNode(breathing(focus)) for focus in (0, 10)))
    assert bank.leave_one_out() == ()
    assert CameraBank(bank.nodes[:1]).gaps(5) == ()


# Repeated calibrations


def test_repeated_calibrations_are_averaged_by_their_covariance() -> None:
    """Against the closed form with inverses, and no surer than the worse of spread and claim."""
    rng = np.random.default_rng(6)
    truth = breathing(30)
    covariances = [covariance_of(truth, sigma) for sigma in (0.1, 0.2, 0.4)]
    cameras = [measured(truth, rng, covariance) for covariance in covariances]
    bank = CameraBank(tuple(map(BankNode, cameras)))
    weights = [np.linalg.inv(covariance) for covariance in covariances]
    expected = np.linalg.solve(
        sum(weights), sum(w @ numbers(c) for w, c in zip(weights, cameras, strict=True))
    )
    found = bank.camera_at(focus=30)
    np.testing.assert_allclose(numbers(found), expected, rtol=1e-5, atol=1e-6)
    (repeat,) = bank.repeats()
    assert (repeat.count, repeat.focus, repeat.hysteresis_px) == (3, 30.0, None)
    claimed = np.linalg.inv(sum(weights)) * max(1.0, repeat.excess)
    np.testing.assert_allclose(np.diag(found.covariance), np.diag(claimed), rtol=1e-3)


def test_the_excess_of_repeats_is_one_when_their_covariance_is_right() -> None:
    rng = np.random.default_rng(17)
    truth = breathing(30)
    right, too_sure = covariance_of(truth, 0.15), covariance_of(truth, 0.05)
    for stated, expected in ((right, 1.0), (too_sure, 9.0)):
        found = []
        for _ in range(25):
            cameras = [replace(measured(truth, rng, right), covariance=stated) for _ in range(3)]
            found.append(CameraBank(tuple(map(BankNode, cameras))).repeats()[0].excess)
        assert np.mean(found) == pytest.approx(expected, rel=0.15)


def test_repeats_without_covariance_are_averaged_plainly() -> None:
    values = numbers(breathing(30))
    cameras = [changed(breathing(30), values * factor, None) for factor in (0.999, 1.001)]
    bank = CameraBank(tuple(map(BankNode, cameras)))
    np.testing.assert_allclose(numbers(bank.camera_at(focus=30)), values, rtol=1e-4, atol=1e-5)
    (repeat,) = bank.repeats()
    assert repeat.excess is None
    assert bank.camera_at(focus=30).covariance is None


def test_hysteresis_is_the_distance_between_the_two_approaches() -> None:
    """A drive with play stops 2 steps of focus apart: the breathing between is what is reported."""
    near, far = (replace(breathing(focus), focus=30.0) for focus in (29.0, 31.0))
    nodes = (BankNode(near, "from near"), BankNode(far, "from far"))
    (repeat,) = CameraBank(nodes).repeats()
    expected = np.linalg.norm(error_px(near, far), axis=-1).max()
    assert repeat.hysteresis_px == pytest.approx(expected, rel=0.02)
    assert repeat.worst_px == pytest.approx(expected / 2, rel=0.05)
    one_sided = CameraBank(nodes).drop(approach="from far")
    np.testing.assert_array_equal(numbers(one_sided.camera_at(focus=30)), numbers(near))
    assert one_sided.repeats() == ()


def test_parameters_that_were_held_fixed_stay_where_they_are() -> None:
    covariance = covariance_of(breathing(30))
    covariance[8], covariance[:, 8] = 0.0, 0.0
    rng = np.random.default_rng(8)
    cameras = [measured(breathing(30), rng, covariance) for _ in range(2)]
    found = CameraBank(tuple(map(BankNode, cameras))).camera_at(focus=30)
    assert found.lens.coefficients[4] == pytest.approx(breathing(30).lens.coefficients[4], abs=1e-9)
    assert found.covariance[8, 8] == pytest.approx(0.0, abs=1e-12)


def test_rational_lenses_are_averaged_by_their_rays() -> None:
    """Numerator and denominator share a factor 1 + a r^2, and k1 is off by 0.01 both ways."""
    k1, k2, p1, p2, _ = breathing(30).lens.coefficients
    truth = replace(breathing(30), lens=BrownLens((k1, k2, p1, p2)))

    def with_factor(a: float, k1: float) -> BrownLens:
        return BrownLens((k1 + a, k2 + a * k1, p1, p2, a * k2, a, 0.0, 0.0))

    lenses = [with_factor(0.3, k1 - 0.01), with_factor(3.0, k1 + 0.01)]
    bank = CameraBank(tuple(BankNode(replace(truth, lens=lens)) for lens in lenses))
    blended = replace(truth, lens=BrownLens(tuple(np.mean([x.coefficients for x in lenses], 0))))
    assert np.abs(error_px(bank.camera_at(focus=30), truth)).max() < 0.1
    assert np.abs(error_px(blended, truth)).max() > 0.3

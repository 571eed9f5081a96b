"""Focus laws: their inverse, the paper's numbers, and fits that know what they are unsure of."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.lens import DioptreLaw, LogLaw, SplineLaw, fit_focus_laws

DEPTHS_M = np.geomspace(0.05, 1.1, 12)
LAWS = [LogLaw(), DioptreLaw(7.0, 3.0), SplineLaw((-3.0, -1.5, 0.0), (130.0, 70.0, 4.0))]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_depth_is_the_inverse_of_value(law) -> None:
    for depth_m in (0.06, 0.2, 0.9):
        assert law.depth_m(law.value(depth_m)) == pytest.approx(depth_m, rel=1e-6)


@pytest.mark.parametrize(("depth_m", "value"), [(0.05, 130), (0.1, 101), (0.5, 33), (1.0, 4)])
def test_equation_3_of_the_paper(depth_m: float, value: int) -> None:
    assert round(LogLaw().value(depth_m)) == value


def test_a_fit_finds_the_law_that_made_the_pairs() -> None:
    fits = fit_focus_laws(DEPTHS_M, [LogLaw(40.0, 6.0).value(z) for z in DEPTHS_M])
    assert fits["log"].law.alpha == pytest.approx(40.0)
    assert next(iter(fits)) == "log"
    fits = fit_focus_laws(DEPTHS_M, [DioptreLaw(7.0, 3.0).value(z) for z in DEPTHS_M])
    assert fits["dioptre"].law.far == pytest.approx(3.0)
    assert next(iter(fits)) == "dioptre"


def test_a_spline_follows_what_neither_law_does() -> None:
    values = 60 - 30 * np.arctan(2 * np.log(DEPTHS_M / 0.3))
    fits = fit_focus_laws(DEPTHS_M, values)
    assert next(iter(fits)) == "spline"
    assert fits["spline"].left_out_rms < 0.3 * fits["log"].left_out_rms


def test_a_spline_of_noisy_pairs_is_monotone() -> None:
    rng = np.random.default_rng(0)
    values = np.array([LogLaw().value(z) for z in DEPTHS_M]) + rng.normal(0, 8, 12)
    law = fit_focus_laws(DEPTHS_M, values)["spline"].law
    assert (np.diff([law.value(z) for z in np.geomspace(0.03, 2, 200)]) < 0).all()


def test_the_covariance_is_that_of_repeated_fits() -> None:
    rng = np.random.default_rng(1)
    true = np.array([42.11, 4.0])
    exact = np.array([LogLaw().value(z) for z in DEPTHS_M])
    squares = []
    for _ in range(60):
        fit = fit_focus_laws(DEPTHS_M, exact + rng.normal(0, 2, 12), [2.0] * 12)["log"]
        off = np.array([fit.law.alpha, fit.law.beta]) - true
        squares.append(off @ np.linalg.solve(fit.covariance, off))
    assert 1.2 < np.mean(squares) < 2.3  # two numbers; a little less, as excess residuals count


@pytest.mark.parametrize(
    ("depths", "values", "match"),
    [
        ([0.1, 0.2], [1, 2], "3 different depths"),
        ([0.1, 0.1, 0.1, 0.1], [1, 2, 3, 4], "3 different depths"),
        ([0.1, -0.2, 0.3], [1, 2, 3], "positive"),
        ([0.1, 0.2, 0.3], [1, np.nan, 3], "positive numbers"),
        ([0.1, 0.2, 0.3], [1, 2], "as many"),
    ],
)
def test_pairs_that_tell_nothing_are_refused(depths, values, match) -> None:
    with pytest.raises(InputError, match=match):
        fit_focus_laws(depths, values)


def test_laws_that_are_none_are_refused() -> None:
    with pytest.raises(InputError, match="slope that is not 0"):
        LogLaw(0.0, 4.0)
    with pytest.raises(InputError, match="rise or all fall"):
        SplineLaw((0.0, 1.0, 2.0), (1.0, 3.0, 2.0))
    with pytest.raises(InputError, match="depth must be positive"):
        LogLaw().value(0.0)

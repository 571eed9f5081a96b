"""Response curves rise, have inverses, and pass through published numbers."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.errors import InputError
from tagmetry.twin.optics.response import Curve, Gamma, Hdr, Linear, Response, Srgb

RESPONSES = [
    Linear(),
    Gamma(2.2),
    Gamma(0.5),
    Srgb(),
    Curve((0.0, 0.1, 0.5, 2.0), (0.05, 0.3, 0.7, 0.95)),
    Hdr(),
    Hdr(stops=0.0, knee=1.0),
    Hdr(stops=12.0, knee=0.01),
]
by_response = pytest.mark.parametrize("response", RESPONSES, ids=str)


@by_response
@given(st.floats(0.0, 1.0))
def test_the_inverse_undoes_the_code(response: Response, share: float) -> None:
    exposure = share * response.full_exposure
    back = response.exposure(response.code(np.array(exposure)))
    np.testing.assert_allclose(back, exposure, rtol=1e-9, atol=1e-12)


@by_response
@given(st.floats(0.0, 1e5), st.floats(0.0, 1e5))
def test_more_light_never_gives_a_lower_code(response: Response, one: float, two: float) -> None:
    low, high = response.code(np.array(sorted((one, two))))
    assert 0 <= low <= high <= 1


@by_response
def test_full_exposure_is_where_the_greatest_code_begins(response: Response) -> None:
    full = response.full_exposure
    below, at, above = response.code(np.array([0.99 * full, full, 50 * full]))
    assert below < at == pytest.approx(above, abs=1e-12)


@by_response
def test_codes_keep_the_shape_and_never_leave_their_range(response: Response) -> None:
    exposure = np.array([[-1.0, -1e-9, 0.0], [1e-12, 1.0, 1e30]])
    codes = response.code(exposure)
    assert codes.shape == (2, 3)
    assert (codes >= 0).all()
    assert (codes <= 1).all()
    assert (codes[0] == codes[0, 2]).all()


@pytest.mark.parametrize("response", [Linear(), Gamma(), Srgb(), Hdr()], ids=str)
def test_single_precision_stays_single(response: Response) -> None:
    light = np.linspace(0, 2, 9, dtype=np.float32)
    assert response.code(light).dtype == np.float32
    assert response.exposure(response.code(light)).dtype == np.float32


def test_gamma_is_a_power() -> None:
    assert Gamma(2.0).code(np.array(0.25)) == pytest.approx(0.5)
    np.testing.assert_array_equal(Gamma(1.0).code(np.array([0.1, 0.7])), [0.1, 0.7])


def test_srgb_passes_through_its_published_numbers() -> None:
    """Middle grey 118 of 255 is 0.18 of the light; 188 is half; 10 lies on the straight part."""
    codes = 255 * Srgb().code(np.array([0.1811642, 0.5028865, 0.0030353, 1.0]))
    np.testing.assert_allclose(codes, [118, 188, 10, 255], atol=2e-3)


def test_a_curve_is_straight_between_its_points_and_level_beyond() -> None:
    curve = Curve((0.1, 0.5, 1.0), (0.2, 0.6, 0.8))
    codes = curve.code(np.array([0.0, 0.1, 0.3, 0.75, 1.0, 9.0]))
    np.testing.assert_allclose(codes, [0.2, 0.2, 0.4, 0.7, 0.8, 0.8])


def test_hdr_is_linear_below_its_knee_and_adds_the_same_for_every_doubling_above() -> None:
    response = Hdr(stops=6.0, knee=0.25)
    low = response.code(np.array([0.0, 0.05, 0.1, 0.25]))
    np.testing.assert_allclose(low / low[1], [0, 1, 2, 5], atol=1e-12)
    stops = response.code(0.25 * 2.0 ** np.arange(9))
    np.testing.assert_allclose(np.diff(stops), np.diff(stops)[0], rtol=1e-12)
    assert np.diff(stops)[0] * 255 > 10  # of 8 bits
    assert stops[-1] == pytest.approx(1.0)


def test_hdr_has_no_bend_at_its_knee() -> None:
    below, at, above = Hdr().code(np.array([0.25 - 1e-6, 0.25, 0.25 + 1e-6]))
    assert above - at == pytest.approx(at - below, rel=1e-4)


def test_hdr_without_stops_is_linear() -> None:
    light = np.linspace(0, 1, 11)
    np.testing.assert_allclose(Hdr(0.0, 1.0).code(light), light, atol=1e-15)


@pytest.mark.parametrize(
    ("exposures", "codes", "text"),
    [
        ((0.0,), (0.0,), "at least two, got 1 and 1"),
        ((0.0, 1.0), (0.0, 0.5, 1.0), "got 2 and 3"),
        ((0.0, 0.0, 1.0), (0.0, 0.5, 1.0), "exposures of a response curve must increase"),
        ((0.0, float("nan")), (0.0, 1.0), "exposures of a response curve must increase"),
        ((0.0, 0.5, 1.0), (0.0, 0.6, 0.5), "codes of a response curve must lie in 0..1 and never"),
        ((0.0, 1.0), (0.0, 1.5), "codes of a response curve must lie in 0..1 and never"),
        ((0.0, 1.0), (0.0, float("nan")), "codes of a response curve must lie in 0..1 and never"),
    ],
)
def test_refuses_points_that_are_no_curve(
    exposures: tuple[float, ...], codes: tuple[float, ...], text: str
) -> None:
    with pytest.raises(InputError, match=text):
        Curve(exposures, codes)


def test_refuses_the_inverse_of_a_curve_that_is_level_in_places() -> None:
    level = Curve((0.0, 0.5, 1.0), (0.0, 1.0, 1.0))
    assert level.full_exposure == 0.5
    with pytest.raises(InputError, match="level in places and has no inverse"):
        level.exposure(np.array(0.5))


def test_refuses_numbers_that_are_no_law() -> None:
    with pytest.raises(InputError, match="exponent of a gamma curve must be positive, got 0"):
        Gamma(0)
    with pytest.raises(InputError, match="0 to 60 stops"):
        Hdr(stops=float("nan"))
    with pytest.raises(InputError, match=r"knee of an HDR response lies in 0..1, got 0.0"):
        Hdr(knee=0.0)

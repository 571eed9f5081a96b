"""Numbers with what they are sure of."""

import pytest

from tagmetry.cli.deviations import decimals_of, with_deviation


@pytest.mark.parametrize(
    ("deviation", "decimals"),
    [
        (120.0, 1),
        (1.0, 1),
        (0.64, 2),
        (0.02, 3),
        (0.0034, 4),
        (1e-9, 4),
        (0.0, 1),
        (float("nan"), 1),
    ],
)
def test_two_digits_of_a_deviation_are_shown(deviation: float, decimals: int) -> None:
    assert decimals_of(deviation) == decimals


def test_a_number_has_the_digits_that_its_deviation_allows() -> None:
    assert with_deviation(-200.01349, 0.0821) == "-200.013 ± 0.082"
    assert with_deviation(3310.8234, 0.64, "+") == "+3310.82 ± 0.64"


def test_nothing_is_a_negative_zero() -> None:
    assert with_deviation(-1e-9, 0.5) == "0.00 ± 0.50"

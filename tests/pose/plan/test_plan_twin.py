"""What is predicted is what the twin's pictures give, over 50 set-ups that differ in everything.

The root mean square of n errors of three directions is itself uncertain by 1 / sqrt(2 n) or less.
"""

from collections.abc import Iterator

import numpy as np
import pytest
from planned_pictures import measured, planned

from tagmetry.geometry import Array
from tagmetry.pose.plan import predict

_MOST_WEIGHED = 5  # large, nearly facing: how the detector weighs corners decides about the angle


def ratios(number: int, count: int) -> Iterator[float]:
    """Give measured by predicted: of the position and of the angle."""
    setup = planned(number)
    one, found = predict(setup), measured(setup, count, np.random.default_rng(number))
    assert found.found > 0.9
    assert found.flipped == pytest.approx(one.flip_probability, abs=0.06)
    yield _rms(found.of_all[:, :3]) / one.position_m
    yield _rms(found.of_all[:, 3:]) / one.angle_rad


def _rms(errors: Array) -> float:
    return float(np.sqrt((errors**2).sum(axis=1).mean()))


@pytest.mark.parametrize("number", [0, 3, 7, 20])
def test_a_few_set_ups(number: int) -> None:
    assert list(ratios(number, 80)) == pytest.approx([1, 1], abs=0.15 + 2 / np.sqrt(2 * 80))


@pytest.mark.slow
@pytest.mark.parametrize("number", range(50))
def test_fifty_set_ups(number: int) -> None:
    position, angle = ratios(number, 300)
    assert position == pytest.approx(1, abs=0.15)
    assert angle == pytest.approx(1, abs=0.15 if number != _MOST_WEIGHED else 0.25)

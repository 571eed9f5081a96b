"""The search for new markers keeps the time that it states, with as few searches as that takes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.detect.track.rota import Rota


def searched_s(per_s: float, acquire_s: float, parts: int, images: int) -> list[float]:
    """Return the times of the images that are searched, at an even rate."""
    rota, times_s = Rota.begun(0.0), []
    for k in range(1, images):
        if k / per_s >= rota.due_s:
            rota = rota.after(k / per_s, 1 / per_s, acquire_s, parts)
            times_s.append(k / per_s)
    return times_s


@given(st.floats(5, 500), st.floats(0.05, 2), st.integers(1, 40))
def test_all_parts_are_searched_in_the_stated_time(
    per_s: float, acquire_s: float, parts: int
) -> None:
    times_s = searched_s(per_s, acquire_s, parts, 400)
    bound_s = max(acquire_s, parts / per_s) + 1e-9
    waits_s = [b - a for a, b in zip(times_s, times_s[parts:], strict=False)]
    assert max(waits_s, default=0.0) <= bound_s


def test_fast_images_are_searched_no_more_often_than_the_time_asks() -> None:
    assert len(searched_s(120.0, 0.5, 20, 1201)) == pytest.approx(400, rel=0.05)


def test_slow_images_are_all_searched() -> None:
    assert len(searched_s(30.0, 0.5, 20, 301)) == 300


def test_after_a_gap_nothing_is_made_up_for() -> None:
    rota = Rota.begun(0.0).after(0.1, 0.01, 0.5, 20)
    late = rota.after(5.0, 4.9, 0.5, 20).after(5.01, 0.01, 0.5, 20)
    assert late.due_s > 5.01

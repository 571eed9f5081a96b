"""A window forgets nothing that lies within it, and lets nothing pass twice."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tagmetry.link.window import WIDTH, ReplayWindow


@given(st.lists(st.integers(0, 3000), max_size=300))
def test_accepts_what_a_list_of_all_would_accept(counters: list[int]) -> None:
    window, heard = ReplayWindow(), set[int]()
    for counter in counters:
        highest = max(heard, default=0)
        expected = counter > 0 and counter not in heard and highest - counter < WIDTH
        assert window.is_new(counter) == expected
        if expected:
            window.add(counter)
            heard.add(counter)
    assert (window.highest, window.count) == (max(heard, default=0), len(heard))


def test_counts_what_is_missing_among_the_last_thousand() -> None:
    window = ReplayWindow()
    assert window.loss() == 0.0
    for counter in range(1, 101):
        if counter % 10:
            window.add(counter)
    window.add(100)
    assert window.loss() == pytest.approx(0.09)
    for counter in range(101, 101 + WIDTH):
        window.add(counter)
    assert window.loss() == 0.0

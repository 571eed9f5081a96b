"""Seed 001 from picture to conclusion, as `tagmetry lab run --quick` runs it."""

import pytest

from tagmetry.lab.experiments import seed001_calibration, seed001_map, seed001_slider

pytestmark = pytest.mark.slow


def test_errors_over_the_floor_are_as_small_as_they_must_be() -> None:
    rows = seed001_map.measure(seed001_map.Case(0), 1)
    said = seed001_map.conclude(rows)
    assert [check.told for check in said.checks if not check.holds] == []
    paper_mm = said.tables[0].rows[2]
    assert 8 < float(paper_mm[2]) < 20  # OpenCV's steps come to what the paper prints, 15 mm


def test_way_and_turn_are_as_exact_as_they_must_be() -> None:
    rows = seed001_slider.measure(seed001_slider.Case(0, 25), 2)
    assert all(check.holds for check in seed001_slider.conclude(rows).checks)


def test_the_camera_is_found_again() -> None:
    rows = seed001_calibration.measure(seed001_calibration.Case(0, 15), 3)
    off = {row.name: (row.value - row.true) / row.sd for row in rows if row.sd > 0}
    assert len(off) == 9
    assert max(map(abs, off.values())) < 4

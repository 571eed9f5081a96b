"""What is said about the limits of a driven lens follows from its readings."""

import numpy as np
import pytest

from tagmetry.lab.beside.lens_limits import conclude
from tagmetry.lab.experiments.lens_limits import Case, cases, measure
from tagmetry.lab.lens_row import LensReading

NAN = float("nan")


def row(case: Case, repeat: int, measured_m: float) -> LensReading:
    return LensReading(
        "tagmetry", case.sweep, "both", 0.01, case.depth_m, case.turn_deg, repeat, -1,
        measured_m, 1e-3 * case.depth_m, case.turn_deg, NAN, NAN, 0, 1, NAN, NAN,
    )  # fmt: skip


def readings(far_m: float, lost_deg: float) -> list[LensReading]:
    """Exact but for depths beyond one, where one of five is off, and lost beyond a turn."""
    rows = []
    for case in cases(quick=False):
        for repeat in range(5):
            share = 1.004 if case.depth_m > far_m and repeat == 3 else 1.0
            lost = case.sweep == "turn" and case.turn_deg > lost_deg and repeat == 1
            rows.append(row(case, repeat, NAN if lost else share * case.depth_m))
    return rows


def test_a_range_ends_where_one_of_five_is_off_or_lost() -> None:
    conclusions = conclude(readings(1.6, 72.0))
    assert conclusions.checks[0].measured == "good from 0.02 to 1.6 m"
    assert conclusions.checks[0].holds
    turns = {line[0]: line[4] for line in conclusions.tables[1].rows}
    assert (turns[72.0], turns[76.0]) == ("yes", "no")
    assert conclusions.figures[0].draw().axes


def test_a_range_that_ends_too_soon_does_not_hold() -> None:
    assert not conclude(readings(0.3, 90.0)).checks[0].holds


@pytest.mark.slow
def test_a_marker_at_the_edge_of_the_range_is_measured() -> None:
    rows = measure(Case("depth", 1.5, 30.0), 3)
    assert np.allclose([one.measured_m for one in rows], 1.5, rtol=3e-3)

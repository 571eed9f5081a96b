"""What is said about readings of driven lenses follows from them."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.lab.beside.lens_readings import LensReadings
from tagmetry.lab.beside.seed000_fixed import conclude as conclude_fixed
from tagmetry.lab.beside.seed000_lens import conclude
from tagmetry.lab.experiments import seed000_fixed, seed000_lens
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.published.seed000 import seed000

EXACT = LensReading(
    "tagmetry", "11", "both", 0.01, 0.5, 30.0, 0, -1, 0.5, 1e-4, 30.0, 0.1, 0.1, 3, 8, 0.3, 0.01
)
NAN = float("nan")


def readings(share: float = 0.0, **changes) -> list[LensReading]:
    """Five results at each condition, off by a share of the depth, and traces."""
    rng = np.random.default_rng(0)
    rows = []
    for case in seed000_lens.cases(quick=True):
        for repeat in range(5):
            off = share + (1e-3 * rng.normal() if case.method == "tagmetry" else 0.005)
            row = replace(
                EXACT,
                method=case.method,
                figure=case.figure,
                size_m=case.size_m,
                depth_m=case.depth_m,
                turn_deg=case.turn_deg,
                measured_deg=case.turn_deg,
                repeat=repeat,
                measured_m=case.depth_m * (1 + off),
                sd_m=1e-3 * case.depth_m,
            )
            rows += [replace(row, **changes)] + [replace(row, image=0)] * (case.figure == "13")
    return rows


def checks(rows: list[LensReading]) -> list[bool | None]:
    return [check.holds for check in conclude(rows).checks]


def test_good_readings_hold_everywhere() -> None:
    conclusions = conclude(readings())
    assert [check.holds for check in conclusions.checks] == [True] * 7
    assert [figure.name[-2:] for figure in conclusions.figures] == ["11", "12", "13", "14", "15"]
    first = conclusions.tables[0].rows[0]
    assert abs(first[2]) < 0.15
    assert first[4] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("changes", "failing"),
    [
        ({"measured_m": 0.6}, [0, 1, 3]),
        ({"measured_m": NAN}, [0, 1, 3]),
        ({"scanned": 12}, [4]),
        ({"simulated_s": 0.6}, [5]),
        ({"busy_s": 0.05}, [6]),
        ({"sd_m": 1.0}, [3]),
    ],
)
def test_poor_readings_fail_where_they_are_poor(changes, failing) -> None:
    held = checks(readings(**changes))
    assert set(failing) <= {n for n, holds in enumerate(held) if not holds}
    assert held.count(False) <= len(failing) + 1


def test_an_error_of_the_turn_fails_and_a_flip_is_counted() -> None:
    rows = [replace(row, measured_deg=row.turn_deg + 0.6) for row in readings()]
    assert "2 of 2 conditions worse" in conclude(rows).checks[2].measured
    flipped = [replace(row, measured_deg=-row.turn_deg) for row in readings()]
    told = conclude(flipped).checks[2]
    assert told.holds
    assert "5 of 10 flipped" in told.measured  # at a turn of 0 there is nothing to flip


def test_a_range_ends_where_one_of_five_is_missing() -> None:
    rows = [
        replace(EXACT, depth_m=z, measured_m=NAN if (z, n) == (0.3, 4) else z, repeat=n)
        for z in (0.05, 0.1, 0.2, 0.3, 0.4)
        for n in range(5)
    ]
    assert LensReadings(tuple(rows)).range_m == pytest.approx(0.15)


def test_figures_9_and_10_have_every_setting() -> None:
    rows = [
        replace(
            EXACT,
            method=method,
            figure=case.figure,
            control=f"W = {case.zoom_percent:g}, F = {case.focus:g}",
            depth_m=case.depth_m,
            measured_m=case.depth_m,
        )
        for case in seed000_fixed.cases(quick=True)
        for method in ("tagmetry", "paper")
    ]
    nine, ten = conclude_fixed(rows).tables
    assert (len(nine.rows), len(ten.rows)) == (3, 5)
    assert ten.rows[0][1] == pytest.approx(1.0)


def test_what_the_paper_says_is_found_by_figure() -> None:
    assert seed000().said("12", "time_s").at == 0.7
    assert seed000().said("64 mm", "turn_deg").at == 3.9


@pytest.mark.slow
def test_one_condition_is_measured_by_both_methods() -> None:
    rows = [
        row
        for method in ("tagmetry", "paper")
        for row in seed000_lens.measure(seed000_lens.Case(method, "64 mm", 0.064, 0.4, 30.0), 1)[:1]
    ]
    assert [row.measured_m for row in rows] == pytest.approx([0.4, 0.4], rel=5e-3)
    assert rows[0].bound_deg < 0.05

"""What is said about readings follows from them: exact ones hold, poor ones fail, in their row."""

import math
from dataclasses import replace

import numpy as np
import pytest
from seed003_rows import positions

from tagmetry.lab.beside.readings import Readings, readings_of
from tagmetry.lab.beside.seed003_calibration import conclude as conclude_calibration
from tagmetry.lab.beside.seed003_pose import conclude
from tagmetry.lab.published.seed003 import seed003
from tagmetry.lab.rows import Quantity


def table(conclusions, name: str):
    return next(one for one in conclusions.tables if one.name == name)


def test_accuracy_is_equation_6() -> None:
    readings = Readings(np.array([-2.0, 0.0, 4.0]), np.array([[-2.1, 0.3, 4.0], [-2.0, 0.0, 4.4]]))
    np.testing.assert_allclose(readings.accuracies_percent, [100 - 5 / 3, 100 - 10 / 3])
    np.testing.assert_allclose(readings.absolute_cm, [[0.1, 0.3, 0.0], [0.0, 0.0, 0.4]])


def test_readings_are_compared_at_the_papers_resolution() -> None:
    readings = Readings(np.array([1.3, 2.6]), np.array([[1.34, 2.66], [1.26, 2.6]]))
    np.testing.assert_allclose(readings.rounded_cm, [0.0, 0.1])


def test_the_line_is_that_of_the_readings() -> None:
    actual = np.array([1.0, 2.0, 3.0])
    line = Readings(actual, np.stack([0.5 + 1.1 * actual] * 2)).line
    assert (line.constant_cm, line.slope) == pytest.approx((0.5, 1.1))


def test_readings_come_in_order_whatever_the_rows_order() -> None:
    rows = positions(0.01)
    own = readings_of(rows[::-1], seed003().positions[2], "tagmetry")
    np.testing.assert_allclose(own.measured_cm[1], np.arange(50.0, 60.0) + 0.01)


def test_exact_readings_hold_everywhere() -> None:
    conclusions = conclude(positions())
    assert len(conclusions.checks) == 18
    assert all(check.holds for check in conclusions.checks)
    assert [row[-1] for row in table(conclusions, "seed003_table13").rows[:2]] == ["better"] * 2
    assert {row[-1] for row in table(conclusions, "seed003_table7").rows[:-1]} == {"equal"}


def test_a_scale_of_half_a_percent_fails_every_accuracy() -> None:
    failed = [check for check in conclude(positions(scale=1.005)).checks if not check.holds]
    assert sum(check.told.startswith("accuracy of") for check in failed) == 9


def test_one_bad_row_is_worse_in_its_table_alone() -> None:
    rows = positions()
    bad = next(n for n, row in enumerate(rows) if (row.table, row.row) == (8, 4))
    rows[bad] = replace(rows[bad], measured_cm=rows[bad].actual_cm + 0.06)
    conclusions = conclude(rows)
    failed = [check.told for check in conclusions.checks if not check.holds]
    assert failed == [
        "accuracy of y at 50 cm",
        "rows of table 8, read to 0.1 cm as the paper does",
    ]
    assert table(conclusions, "seed003_table8").rows[4][-1] == "worse"


def test_a_marker_that_was_not_found_is_no_accuracy() -> None:
    rows = positions()
    rows[0] = replace(rows[0], measured_cm=math.nan)
    check = conclude(rows).checks[0]
    assert check.holds is False


def test_mistakes_show_in_the_lines() -> None:
    rows = positions() + [replace(r, assumed="wrong") for r in positions(scale=1.01)]
    mistakes = table(conclude(rows), "seed003_mistakes")
    assert mistakes.header[-1] == "ours, wrong"
    assert {row[-1] for row in mistakes.rows} <= {"0.000 + 1.0100 X", "-0.000 + 1.0100 X"}


def test_every_figure_of_the_paper_is_there_and_draws() -> None:
    pytest.importorskip("matplotlib")
    figures = conclude(positions(0.01)).figures
    assert [figure.name for figure in figures] == [f"seed003_figure{n}" for n in range(10, 24)]
    for figure in figures[:2]:
        assert figure.draw().axes


def test_a_calibration_is_held_against_the_printed_error() -> None:
    rows = [
        Quantity(method, 0, name, value, math.nan, math.nan)
        for method in ("tagmetry", "paper")
        for name, value in (
            ("rms px", 0.1),
            ("tutorial error px", 0.019),
            ("projection rms px", 0.1),
            ("views", 35.0),
        )
    ]
    rows += [
        Quantity(method, 0, name, 1.0 + error, 1.0, 0.1)
        for method, error in (("tagmetry", 0.0), ("paper", 0.2))
        for name in ("fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3")
    ]
    conclusions = conclude_calibration(rows)
    assert [check.holds for check in conclusions.checks] == [False]
    camera = table(conclusions, "seed003_camera")
    assert camera.rows[0] == ("fx", 1.0, 1.0, 0.0, 0.1, 1.2, pytest.approx(0.2), "yes")

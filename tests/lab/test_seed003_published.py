"""The printed tables are copied right: what the notes and the paper compute from them comes out."""

import numpy as np
import pytest

from tagmetry.lab.beside.readings import printed
from tagmetry.lab.published.seed003 import PositionTable, seed003

TABLES = {table.table: table for table in seed003().positions}


def test_there_are_all_tables() -> None:
    places = [(table.axis, table.distance_cm) for table in seed003().positions]
    assert list(TABLES) == list(range(7, 16))
    assert places == [(axis, distance_cm) for distance_cm in (50, 70, 100) for axis in "xyz"]
    figures = [number for table in TABLES.values() for number in table.figures or ()]
    assert figures == list(range(10, 24))


@pytest.mark.parametrize("table", [table for table in TABLES.values() if table.regression])
def test_the_printed_lines_fit_the_printed_rows(table: PositionTable) -> None:
    constant_cm, slope = table.regression
    line = printed(table).line
    assert line.slope == pytest.approx(slope, abs=6e-4)
    assert line.constant_cm == pytest.approx(constant_cm, abs=6e-4)


@pytest.mark.parametrize("table", TABLES.values())
def test_the_printed_errors_follow_from_the_rows_but_for_the_misprints(
    table: PositionTable,
) -> None:
    misprints = {11: {0: 0, 2: 1, 8: 1}, 13: {6: 1, 7: 1}}.get(table.table, {})
    rows = np.array(table.rows)
    differs = np.abs(np.abs(rows[:, 0] - rows[:, 1]) - rows[:, 2]) > 0.01
    assert set(np.flatnonzero(differs)) == {n for n, is_wrong in misprints.items() if is_wrong}


@pytest.mark.parametrize(
    ("number", "absolute_cm", "percent"),
    [
        (9, 0.110, 0.195),
        (10, 0.0727, 0.894),
        (11, 0.05, 1.051),
        (14, 0.1, 2.359),
        (15, 1.77, 1.685),
    ],
)
def test_means_of_the_rows_are_those_of_the_notes(
    number: int, absolute_cm: float, percent: float
) -> None:
    readings = printed(TABLES[number])
    assert readings.absolute_cm.mean() == pytest.approx(absolute_cm, abs=6e-4)
    assert 100 - readings.accuracies_percent[0] == pytest.approx(percent, abs=1e-3)


def test_without_its_misprints_table_13_has_the_line_of_the_remark() -> None:
    table = TABLES[13]
    rows = [row if row[0] not in (2.6, 4.6) else [row[1] + row[2], *row[1:]] for row in table.rows]
    line = printed(table.model_copy(update={"rows": rows})).line
    assert (line.constant_cm, line.slope) == pytest.approx((0.0, 1.035), abs=5e-4)
    assert any("0.000 + 1.035 X" in remark for remark in seed003().remarks)

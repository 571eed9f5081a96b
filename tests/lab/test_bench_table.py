"""Tables: numbers with the digits that count, everything within 100 columns."""

import pytest
from rich.console import Console

from tagmetry.lab.bench import Results, Row
from tagmetry.lab.bench.compare import compared
from tagmetry.lab.bench.costs import Cost
from tagmetry.lab.bench.machine import this_machine
from tagmetry.lab.bench.table import change_table, failures, number, tables

FULL = Row(
    "real-mocap_aprilgrid",
    "opencv-apriltag",
    1,
    "processor",
    2.07,
    rounds=50,
    p50_ms=1234.5,
    p99_ms=2345.6,
    ratio=345.67,
    memory_mib=1234.5,
    expected=4320,
    found=4311,
    false_positives=123,
    corner_rms_px=0.00384,
    bound_px=0.00351,
    position_error_percent=0.0123,
    angle_error_deg=0.0456,
    flips=999,
)


def printed(*things: object) -> str:
    console = Console(width=100)
    with console.capture() as capture:
        console.print(*things, sep="\n")
    return capture.get()


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (1234.5, 3, "1234"),
        (123.4, 3, "123"),
        (12.34, 3, "12.3"),
        (0.1234, 3, "0.123"),
        (0.00384, 2, "0.0038"),
        (0.0, 3, "0"),
        (None, 3, "-"),
        (1e-9, 3, "0.0000"),
    ],
)
def test_numbers_have_the_digits_that_count(value: float | None, digits: int, text: str) -> None:
    assert number(value, digits) == text


def test_a_row_fits_into_100_columns_with_all_its_numbers() -> None:
    results = Results(this_machine(), "tag36h11", (FULL,))
    text = printed(*tables(results))
    line = next(line for line in text.splitlines() if "opencv-apriltag" in line)
    assert line.split() == [
        "opencv-apriltag", "1234", "2346", "346x", "4311/4320", "123", "0.0038", "0.0035",
        "0.012", "0.046", "999", "1234",
    ]  # fmt: skip


def test_costs_and_goals_stand_below() -> None:
    ours = Row("none", "tagmetry", 1, "processor", 2.0, p50_ms=1.0)
    cost = Cost("tagmetry", 1, 0.25, 1.5, 0.125, 4.0)
    text = printed(*tables(Results(this_machine(), "tag36h11", (ours,), (cost,))))
    assert ["tagmetry", "1", "0.250", "1.50", "0.125", "4.0"] in [
        line.split() for line in text.splitlines()
    ]
    assert "none: false positives" in text
    assert "holds" in text


def test_a_failure_is_said() -> None:
    dead = Row("night", "apriltag", 1, "processor", 0.1, failure="crashed (SIGSEGV)")
    assert failures(Results(this_machine(), "", (dead, FULL))) == [
        "night: apriltag crashed (SIGSEGV)"
    ]


def test_two_runs_fit_beside_each_other() -> None:
    both = Results(this_machine(), "", (FULL,))
    text = printed(change_table(compared(both, both)))
    line = next(line for line in text.splitlines() if "opencv-apriltag" in line)
    assert "1.00x" in line
    assert "4311/4320" in line

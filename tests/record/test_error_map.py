"""Error maps as tables and pictures, of few markers, of many, and with lost ones."""

import csv
import io

import numpy as np
import pytest

from tagmetry.arena import ErrorMap, GridPlace
from tagmetry.record.error_map import error_map_csv, error_map_figure, error_map_picture


def error_map(count: int, lost_m: float = 0.0, *, in_line: bool = False) -> ErrorMap:
    rng = np.random.default_rng(0)
    true = rng.uniform(-1, 1, (count, 2))
    if in_line:
        true[:, 1] = 0.3
    errors = 1e-3 * rng.standard_normal((count, 2))
    errors[0] += lost_m
    ids = np.arange(5, 5 + count)
    sd = np.full(count, 1e-3)
    return ErrorMap(ids, true, true + errors, sd, np.zeros(2), GridPlace(), ())


def test_a_table_has_a_line_for_each_marker() -> None:
    found = error_map(7)
    rows = list(csv.DictReader(io.StringIO(error_map_csv(found))))
    assert [int(row["id"]) for row in rows] == found.ids.tolist()
    for n, row in enumerate(rows):
        error = float(row["measured_x_m"]) - float(row["x_m"])
        assert error == pytest.approx(float(row["error_x_m"]), abs=2e-6)
        assert float(row["error_m"]) == pytest.approx(found.radial_m[n], abs=1e-6)


@pytest.mark.parametrize(
    "found",
    [error_map(3), error_map(40), error_map(40, 0.5), error_map(12, in_line=True)],
    ids=["few", "many", "one lost", "in a line"],
)
def test_every_map_can_be_drawn(found: ErrorMap) -> None:
    pytest.importorskip("matplotlib")
    assert error_map_picture(found).startswith(b"\x89PNG")
    title = error_map_figure(found, "lab").axes[0].get_title(loc="left")
    assert title.startswith("lab: worst ")


def test_a_lost_marker_does_not_drown_the_others() -> None:
    pytest.importorskip("matplotlib")
    colours = error_map_figure(error_map(60, 0.5)).axes[1]
    assert colours.get_ylim()[1] < 20  # mm, where one error is 700

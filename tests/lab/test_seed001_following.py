"""Leader and follower: what is concluded from their drives, and one short drive."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.lab.beside.seed001_following import conclude
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.rows import FollowingMoment


def drive(delay_s=0.05, slippery=False, errors_mm=(0.0, 3.0, -5.0), touching=False):
    return [
        FollowingMoment(
            delay_s, slippery, 0, 0.1 * n, 0.2 * n, 0.0, 0.2 * n - 0.2, 0.0, 0.2 + error / 1000,
            0.2, 0.011, 0.03, 0.01, touching,
        )
        for n, error in enumerate(errors_mm)
    ]  # fmt: skip


def both(**more):
    return [*drive(slippery=False, **more), *drive(slippery=True, **more)]


def test_the_worst_and_the_mean_error_stand_in_the_table():
    table = conclude(both()).tables[0]
    assert table.rows[0][2:4] == (pytest.approx(42), pytest.approx(41))
    clean = table.rows[1]
    assert clean[0] == "50"
    assert clean[2:5] == (pytest.approx(5), pytest.approx(8 / 3, rel=1e-2), pytest.approx(195))
    assert clean[5] == pytest.approx(1, rel=1e-3)
    assert clean[6] == pytest.approx(20, rel=1e-3)


@pytest.mark.parametrize(
    ("changes", "holds"),
    [
        ({}, True),
        ({"errors_mm": (0.0, 21.0)}, False),
        ({"touching": True}, False),
        ({"delay_s": 0.15, "errors_mm": (0.0, 30.0)}, None),
    ],
)
def test_what_holds(changes, holds):
    assert {check.holds for check in conclude(both(**changes)).checks} == {holds}


def test_published_figures_are_the_paper_s():
    printed = seed001().following
    assert (printed.gap_m, printed.worst_m, printed.mean_m) == (0.2, 0.042, 0.041)


def test_its_figures_can_be_drawn():
    pytest.importorskip("matplotlib")
    for figure in conclude(both()).figures:
        assert figure.draw().axes


def test_a_drive_through_the_twin():
    pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")
    from tagmetry.lab.experiments import seed001_following as experiment

    case = replace(experiment.cases(True)[0], slippery=True)
    experiment_s, experiment._DURATION_S = experiment._DURATION_S, 4.0
    try:
        rows = experiment.measure(case, 1)
    finally:
        experiment._DURATION_S = experiment_s
    gaps = np.array([row.gap_m for row in rows])
    assert np.abs(gaps - 0.2).max() < 0.02
    assert rows[-1].leader_x_m > -0.5
    headings = np.array([row.seen_heading_rad - row.true_heading_rad for row in rows])
    assert np.abs(headings).max() < 0.02

"""Swarms: what is concluded from known runs, and a short one through the twin."""

from dataclasses import replace
from math import nan

import numpy as np
import pytest

from tagmetry.lab.beside.swarm import conclude
from tagmetry.lab.rows import SwarmPlace


def run(task="disperse", robots=4, seconds=20, gap_m=lambda s: min(0.22 + 0.05 * s, 0.42), cpu=0.5):
    """Return robots in a row whose neighbours are so far away."""
    return [
        SwarmPlace(
            task, robots, 0, float(s), robot, gap_m(s) * (robot - (robots - 1) / 2), 0.0, gap_m(s),
            gap_m(s) if task == "formation" else nan, 3, False, cpu * s,
        )
        for s in range(seconds)
        for robot in range(robots)
    ]  # fmt: skip


def held(rows):
    return [check.holds for check in conclude(rows).checks]


def test_it_says_since_when_a_swarm_has_converged_and_how_fast_it_was():
    row = conclude(run()).tables[0].rows[0]
    assert row[:2] == ("disperse", 4)
    assert row[2:4] == (pytest.approx(220), pytest.approx(420))
    assert row[4] == 4  # 0.42 m from there on; a second before it is still 20 mm of 200 off
    assert row[5] == pytest.approx(220)
    assert row[8] == pytest.approx(2)


@pytest.mark.parametrize(
    ("rows", "holds"),
    [
        (run(), [True, True, True]),
        (run(gap_m=lambda _s: 0.40), [False, True, True]),
        (run(cpu=1.5), [True, True, False]),
        (run(robots=100, cpu=1.5), [True, True, None]),
        ([replace(row, has_touched=row.robot == 2) for row in run()], [True, False, True]),
        (run("formation", gap_m=lambda s: 0.1 if s < 10 else 0.029), [True, True, True]),
        (run("formation", gap_m=lambda s: 0.1 if s < 10 else 0.031), [False, True, True]),
    ],
)
def test_what_holds(rows, holds):
    assert held(rows) == holds


@pytest.mark.parametrize(("gap_m", "gathered"), [(0.31, True), (0.33, False)])
def test_a_chain_of_near_ones_is_one_crowd(gap_m, gathered):
    """Two rows of five at 200 mm, so far from each other."""
    x_m = [0.2 * n for n in range(5)]
    x_m += [x_m[-1] + gap_m + one for one in x_m]
    rows = [
        SwarmPlace("aggregate", 10, 0, t, n, x, 0.0, 0.2, nan, 9, False, t)
        for t in (0.0, 1.0)
        for n, x in enumerate(x_m)
    ]
    check = conclude(rows).checks[0]
    assert check.holds is gathered
    assert check.measured == ("1" if gathered else "2")


def test_its_figures_can_be_drawn():
    pytest.importorskip("matplotlib")
    figures = conclude([*run(), *run("formation")]).figures
    assert [one.name for one in figures] == [
        "swarm_curves", "swarm_disperse_4", "swarm_formation_4",
    ]  # fmt: skip
    for figure in figures:
        assert figure.draw().axes


def test_a_swarm_in_the_twin():
    pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")
    from tagmetry.lab.experiments import swarm

    case = replace(swarm.cases(True)[0], task="formation", robots=4, duration_s=2.0)
    rows = swarm.measure(case, 1)
    assert sorted({row.robot for row in rows}) == [0, 1, 2, 3]
    assert {round(row.time_s) for row in rows} == {0, 1}
    assert rows[-1].cpu_s > 0
    assert max(row.off_m for row in rows) < 0.2
    assert all(row.told == 3 for row in rows)


def test_many_robots_start_where_the_camera_sees_them():
    pytest.importorskip("mujoco", reason="simulated robots need the extra `robots`")
    from tagmetry.lab.rigs.swarm import TASKS, swarm_scenario

    for task in TASKS:
        for robots in (24, 36, 100):
            scenario = swarm_scenario(task, robots, 0)
            xyz = [[one.start.x_m, one.start.y_m, 0.093] for one in scenario.robots]
            pixels, _ = scenario.view.project(np.array(xyz))
            assert (pixels > 40).all()
            assert (pixels < np.array(scenario.view.camera.size_px) - 40).all()
            apart = np.linalg.norm(np.array(xyz)[:, None] - xyz, axis=-1) + np.eye(robots)
            assert apart.min() > 0.17

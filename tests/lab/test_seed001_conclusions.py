"""What is concluded from rows that are known, and what the paper prints."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.lab.beside import (
    seed001_calibration,
    seed001_map,
    seed001_rate,
    seed001_slider,
)
from tagmetry.lab.published.seed001 import seed001
from tagmetry.lab.registry import experiment
from tagmetry.lab.rigs.overhead import BOARD, CAMERA, GRID, T_WORLD_CAMERA, board_pictures
from tagmetry.lab.rigs.overhead_paper import fitted
from tagmetry.lab.rigs.slider import DURATION_S, places, way_and_turn
from tagmetry.lab.rows import FloorError, Quantity, Rate, SliderPlace
from tagmetry.record.report import ReportFigure


def test_the_paper_says_what_its_text_prints() -> None:
    said = seed001()
    assert (said.error_map.markers, said.error_map.step_m) == (360, 0.068)
    assert (said.error_map.corner_m, said.error_map.center_m) == (0.015, 0.001)
    assert (said.slider.length_m, said.slider.position_m, said.slider.angle_rad) == (
        0.81,
        0.002,
        0.02,
    )
    assert said.slider.turns_rad == pytest.approx(4 * np.pi / 2)
    assert [(one.robots, one.per_s) for one in said.rates] == [(0, 120), (13, 60), (24, 30)]


@pytest.mark.parametrize("name", ["calibration", "map", "slider", "rate"])
def test_experiments_are_listed_with_their_cases(name: str) -> None:
    found = experiment(f"seed001-{name}")
    assert found.source.startswith("seed 001")
    assert len(found.cases(True)) < len(found.cases(False))


def test_the_whole_grid_and_the_whole_rail_are_in_the_image() -> None:
    half = GRID.size_m / 2 * 1.25
    at = [
        (x + a, y + b, 0.0) for x, y in GRID.places_m for a in (-half, half) for b in (-half, half)
    ]
    at += [(x, y, 0.1) for x, y, _ in places(np.linspace(0, DURATION_S, 9))]
    assert CAMERA.contains(CAMERA.project(T_WORLD_CAMERA.inv().apply(at))).all()
    assert GRID.count == 360


def test_boards_are_held_in_the_image() -> None:
    (one,) = board_pictures(1, np.random.default_rng(0))
    assert one.shape == (1080, 1920)
    assert BOARD.columns * BOARD.rows // 2 <= 250


def test_the_slider_goes_its_way_and_turns_once() -> None:
    way_m, turn_rad = way_and_turn(np.array([0.0, DURATION_S / 2, DURATION_S, 9.0]))
    np.testing.assert_allclose(way_m, [0, 0.405, 0.81, 0.81])
    np.testing.assert_allclose(turn_rad, [0, np.pi, 2 * np.pi, 2 * np.pi])


def test_fitting_takes_a_motion_away_and_nothing_else() -> None:
    rng = np.random.default_rng(0)
    true = rng.uniform(-1, 1, (30, 3))
    c, s = np.cos(0.4), np.sin(0.4)
    moved = true @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]]) + [3.0, -2.0, 0.4]
    np.testing.assert_allclose(fitted(moved, true), true, atol=1e-12)
    stretched = fitted(moved * [1.01, 1.01, 1], true) - true
    middle = true[:, :2].mean(axis=0)
    np.testing.assert_allclose(stretched[:, :2], 0.01 * (true[:, :2] - middle), atol=1e-12)


def floor_errors(error_m: float) -> list[FloorError]:
    return [
        FloorError(method, 0, n, x, y, error_m, 0.0, 1e-4)
        for method in ("tagmetry", "paper")
        for n, (x, y) in enumerate(GRID.places_m.tolist())
    ]


@pytest.mark.parametrize(
    ("error_m", "holds"),
    [(4e-4, [True, True, True]), (6e-4, [True, False, True]), (4e-3, [False, False, True])],
)
def test_the_map_is_held_against_what_must_hold(error_m: float, holds: list[bool]) -> None:
    said = seed001_map.conclude(floor_errors(error_m))
    assert [check.holds for check in said.checks] == holds
    assert said.tables[0].rows[1][1] == pytest.approx(1000 * error_m)


def test_a_marker_that_was_not_found_is_told() -> None:
    rows = floor_errors(1e-4)
    rows[7] = replace(rows[7], error_x_m=np.nan)
    said = seed001_map.conclude(rows)
    assert said.checks[2].holds is False
    assert said.checks[2].measured == "359 of 360"


def slid(error_m: float, error_rad: float) -> list[SliderPlace]:
    return [
        SliderPlace(method, 0, 0.1 * n, 0.02 * n, 0.1 * n, error_m, error_rad, 1e-4, 1e-3)
        for method in ("tagmetry", "paper")
        for n in range(10)
    ]


@pytest.mark.parametrize(
    ("error_m", "error_rad", "holds"),
    [
        (9e-4, -4e-3, [True, True]),
        (-1.1e-3, 4e-3, [False, True]),
        (1e-4, 6e-3, [True, False]),
        (np.nan, np.nan, [False, False]),
    ],
)
def test_the_slider_is_held_against_what_must_hold(
    error_m: float, error_rad: float, holds: list[bool]
) -> None:
    rows = slid(1e-4, 1e-4)
    rows[3] = replace(rows[3], error_m=error_m, error_rad=error_rad)
    assert [check.holds for check in seed001_slider.conclude(rows).checks] == holds


def test_rates_are_held_against_the_published() -> None:
    rows = [Rate("tagmetry", 13, 13.0, 5.0, 6.0), Rate("tagmetry", 24, 23.9, 50.0, 60.0)]
    rows.append(Rate("paper", 24, 24.0, 50.0, 60.0))
    said = seed001_rate.conclude(rows)
    assert [check.holds for check in said.checks] == [True, False, False]
    assert said.checks[0].measured == "200"
    assert "fewer with 24" in said.checks[2].measured


def test_the_camera_is_held_against_the_paper() -> None:
    names = (*seed001_calibration.PARAMETERS, "projection rms px")
    rows = [
        Quantity(method, 0, name, 1.0 + off, 1.0, 0.01)
        for method, off in (("tagmetry", 0.005), ("paper", 0.02))
        for name in names
    ]
    rows += [Quantity(method, 0, "rms px", 0.1, np.nan, np.nan) for method in ("tagmetry", "paper")]
    said = seed001_calibration.conclude(rows)
    assert [check.holds for check in said.checks] == [True, True]
    assert "p1, is off by 50.0 %" in said.checks[0].measured


@pytest.mark.parametrize(
    "figures",
    [
        seed001_map.conclude(floor_errors(1e-3)).figures,
        seed001_slider.conclude(slid(1e-4, 1e-4)).figures,
        seed001_rate.conclude([Rate("tagmetry", 1, 1.0, 2.0, 3.0)]).figures,
    ],
    ids=["map", "slider", "rate"],
)
def test_figures_can_be_drawn(figures: tuple[ReportFigure, ...]) -> None:
    pytest.importorskip("matplotlib")
    for figure in figures:
        assert figure.draw().axes

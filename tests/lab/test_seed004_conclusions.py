"""What is said about robots follows from the rows: bounds, trends, what is lost."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tagmetry.lab.beside.sample import sample
from tagmetry.lab.beside.seed004_backlight import conclude as conclude_backlight
from tagmetry.lab.beside.seed004_distance import conclude as conclude_distance
from tagmetry.lab.beside.seed004_repeat import conclude as conclude_repeat
from tagmetry.lab.beside.seed004_repeat import gaps_m
from tagmetry.lab.published.seed004 import seed004
from tagmetry.lab.rows import RobotPlace

NAN = math.nan


def row(**told) -> RobotPlace:
    plain = {
        "method": "planar", "camera": "webcam", "layout": "one", "size_m": 0.1,
        "distance_m": 1.0, "place": -1, "window": 0.0, "repeat": 0, "x_m": 0.003, "y_m": 0.004,
        "heading_rad": 1e-3, "sd_place_m": 0.005, "sd_heading_rad": 1e-3, "mahalanobis2": 3.0,
        "markers": 1,
    }  # fmt: skip
    return RobotPlace(**{**plain, **told})


def sweep() -> list[RobotPlace]:
    """Errors that grow with the distance, and are as the paper says of cameras and markers."""
    rng = np.random.default_rng(0)
    settings = [
        ("webcam", "one", 0.1, 1.0),
        ("HDR, normal", "one", 0.1, 2.0),
        ("HDR, wide", "one", 0.1, 3.0),
        ("HDR, wide", "one", 0.06, 4.0),
        ("HDR, wide", "two", 0.06, 2.0),
    ]
    return [
        row(
            method=method, camera=camera, layout=layout, size_m=size_m, distance_m=distance_m,
            repeat=repeat, x_m=1e-3 * size * distance_m**2 * rng.uniform(0.9, 1.1) * worse,
            y_m=0.0, heading_rad=1e-3 * size * worse * rng.uniform(0.9, 1.1),
        )
        for method, worse in (("paper", 5.0), ("planar", 1.0))
        for camera, layout, size_m, size in settings
        for distance_m in (0.2, 1.0, 1.1, 1.5)
        for repeat in range(4)
    ]  # fmt: skip


def rounds(gap_m: float = 0.0) -> list[RobotPlace]:
    rng = np.random.default_rng(1)
    return [
        row(
            method=method, camera="HDR, normal", layout="corner", size_m=size_m, distance_m=0.0,
            place=place, repeat=repeat, x_m=size_m_error * rng.uniform(0.9, 1.1),
            y_m=gap_m if place == 3 else 0.0,
        )
        for method in ("paper", "planar")
        for size_m, size_m_error in ((0.16, 1e-3), (0.1, 2e-3))
        for place in range(4)
        for repeat in range(5)
    ]  # fmt: skip


def check(conclusions, words: str):
    return next(one for one in conclusions.checks if words in one.told)


def test_everything_the_paper_says_holds_of_errors_that_are_so():
    conclusions = conclude_distance(sweep())
    assert all(one.holds for one in conclusions.checks)
    assert len(conclusions.checks) == 9
    assert "0.2" in check(conclusions, "rms error of the place").measured


def test_a_camera_that_errs_near_by_is_not_good_enough():
    rows = [replace(r, x_m=10 * r.x_m) if r.camera == "HDR, wide" else r for r in sweep()]
    conclusions = conclude_distance(rows)
    assert check(conclusions, "HDR, wide: the accuracy").holds is False
    assert check(conclusions, "webcam: the accuracy").holds is True


def test_one_lost_picture_near_by_fails_and_is_told():
    rows = sweep()
    n = next(n for n, r in enumerate(rows) if r.method == "planar" and r.distance_m == 1.0)
    rows[n] = replace(rows[n], x_m=NAN, y_m=NAN, heading_rad=NAN)
    found = check(conclude_distance(rows), "webcam: the accuracy")
    assert found.holds is False
    assert "1 of 4 not localized" in found.measured


def test_backlight_asks_the_webcam_of_nothing_but_the_papers_detector_to_be_lost():
    def pictures(camera, method, lost):
        x_m = NAN if lost else 1e-3
        return [
            row(camera=camera, method=method, window=w, x_m=x_m, repeat=n)
            for w in (1.0, 100.0)
            for n in range(3)
        ]

    rows = [
        *pictures("webcam", "paper", True),
        *pictures("webcam", "planar", False),
        *pictures("HDR, normal", "paper", False),
        *pictures("HDR, normal", "planar", False),
    ]
    assert [one.holds for one in conclude_backlight(rows).checks] == [True, None, True]
    lost = [replace(r, x_m=NAN) if r.camera == "HDR, normal" else replace(r, x_m=0) for r in rows]
    assert [one.holds for one in conclude_backlight(lost).checks] == [False, None, False]


def test_a_triangle_that_does_not_close_is_told():
    assert all(one.holds for one in conclude_repeat(rounds()).checks)
    open_ = conclude_repeat(rounds(gap_m=0.02))
    assert [one.holds for one in open_.checks[:2]] == [False, False]
    part = sample(rounds(gap_m=0.02)).where(method="planar", size_m=0.16)
    np.testing.assert_allclose(gaps_m(part), 0.02, atol=1e-4)


def test_every_figure_can_be_drawn():
    pytest.importorskip("matplotlib")
    for conclude, rows, names in (
        (conclude_distance, sweep(), ["seed004_figure7", "seed004_figure10"]),
        (conclude_repeat, rounds(), ["seed004_figure12", "seed004_figure13"]),
    ):
        figures = conclude(rows).figures
        assert [one.name for one in figures] == names
        assert all(one.draw() is not None for one in figures)


def test_what_is_published_is_said_of_its_figures():
    assert [len(seed004().words(n)) for n in (7, 8, 10, 12, 13)] == [3, 1, 1, 1, 1]
    assert "no number" in seed004().remarks[0]

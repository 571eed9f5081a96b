"""What is said about localization follows from the rows, with intervals from a table of Student."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tagmetry.lab.beside.sample import Sample, difference, mean_of, rounded, sample
from tagmetry.lab.beside.seed002_tilt import conclude as conclude_tilt
from tagmetry.lab.beside.seed002_yaw import conclude as conclude_yaw
from tagmetry.lab.beside.seed002_zones import conclude as conclude_zones
from tagmetry.lab.published.seed002 import seed002
from tagmetry.lab.rows import Localization

LAYOUTS = ("one", "two", "four", "four inclined", "four and one perpendicular")


def row(**told) -> Localization:
    plain = {
        "method": "joint",
        "layout": "one",
        "look": "simulator",
        "distance_m": 4.0,
        "yaw_deg": 0.0,
        "pitch_deg": 0.0,
        "roll_deg": 0.0,
        "zone": -1,
        "assumed": "right",
        "repeat": 0,
        "radial_m": 0.01,
        "xy_m": 0.008,
        "z_m": 0.006,
        "angle_rad": 1e-3,
        "turn_rad": 2e-3,
        "sd_radial_m": 0.01,
        "sd_angle_rad": 1e-3,
        "mahalanobis2": 6.0,
        "probability": 1.0,
    }
    return Localization(**{**plain, **told})


def sweep(**told) -> list[Localization]:
    """Errors that grow with the distance, and shrink with every layout."""
    rng = np.random.default_rng(0)
    return [
        row(
            method=method,
            layout=layout,
            look=look,
            distance_m=float(distance_m),
            yaw_deg=float(yaw_deg),
            repeat=repeat,
            radial_m=1e-3 * distance_m / (n + 1) * rng.uniform(0.9, 1.1),
            **told,
        )
        for method in ("joint", "paper, 1 / distance")
        for n, layout in enumerate(LAYOUTS)
        for look in ("simulator", "webcam")
        for distance_m in range(1, 8)
        for yaw_deg in (0, 90)
        for repeat in range(4)
    ]


def check(conclusions, words: str):
    return next(one for one in conclusions.checks if words in one.told)


def test_a_mean_has_students_interval() -> None:
    mean = mean_of(np.array([1.0, 2.0, 3.0, 4.0, np.nan]))
    assert (mean.mean, mean.count, mean.missing) == (2.5, 4, 1)
    assert mean.half == pytest.approx(3.182 * 1.29099 / 2, rel=1e-3)  # t of 3 at 97.5 %
    assert (mean.low, mean.high) == (mean.mean - mean.half, mean.mean + mean.half)


def test_means_of_too_few() -> None:
    assert math.isnan(mean_of(np.array([])).mean)
    one = mean_of(np.array([2.0]))
    assert one.mean == 2.0
    assert math.isnan(one.half)


def test_intervals_cover_the_truth_in_95_of_100() -> None:
    rng = np.random.default_rng(3)
    means = [mean_of(rng.standard_normal(6)) for _ in range(2000)]
    assert np.mean([one.low < 0 < one.high for one in means]) == pytest.approx(0.95, abs=0.015)
    pairs = [difference(rng.normal(1, 1, 5), rng.normal(0, 3, 9)) for _ in range(2000)]
    assert np.mean([one.low < 1 < one.high for one in pairs]) == pytest.approx(0.95, abs=0.015)


def test_numbers_to_three_digits() -> None:
    assert [rounded(x) for x in (1234.5, 0.0098765, 0.0)] == [1230, 0.00988, 0]
    assert math.isnan(rounded(math.nan))


def test_samples_are_picked_and_grouped() -> None:
    rows = sample(sweep())
    part = rows.ours.where(layout="two", look="webcam").within(2, 3)
    assert {(r.method, r.layout, r.look) for r in part.rows} == {("joint", "two", "webcam")}
    assert list(part.by("distance_m")) == [2.0, 3.0]
    assert part.values("angle_deg")[0] == pytest.approx(math.degrees(1e-3))
    assert sample([row(z_m=-2.0)]).values("abs_z_m").tolist() == [2.0]
    assert Sample((row(method="covariance"),)).ours.rows


def test_good_errors_hold_and_angles_in_degrees_are_not_asked_beyond_the_noise() -> None:
    conclusions = conclude_yaw(sweep())
    assert check(conclusions, "one: remains below 10 cm").holds is True
    assert check(conclusions, "four inclined: exceeding 10 cm").holds is True
    assert check(conclusions, "one: mean angular error below 0.02").holds is None
    assert "noise of the corners alone" in check(conclusions, "mean angular error below").measured
    assert check(conclusions, "one: the same taken as radians").holds is True
    assert all(one.holds for one in conclusions.checks if one.told.startswith("trend"))


def test_angles_in_degrees_fail_where_the_corners_would_tell_them() -> None:
    assert check(conclude_yaw(sweep(sd_angle_rad=1e-6)), "error below 0.02").holds is False


def test_one_large_distance_or_one_lost_picture_fails_its_statement() -> None:
    rows = sweep()
    far = next(n for n, r in enumerate(rows) if (r.layout, r.distance_m) == ("one", 3.0))
    for bad in (replace(rows[far], radial_m=5.0), replace(rows[far], radial_m=math.nan)):
        conclusions = conclude_yaw([*rows[:far], bad, *rows[far + 1 :]])
        assert check(conclusions, "one: remains below 10 cm").holds is False
        assert check(conclusions, "two: around 5 cm").holds is True
    assert "1 of 8 not localized" in check(conclusions, "one: remains").measured


def test_half_of_the_weighted_average_is_asked_of_the_whole_grid() -> None:
    joint = [r for r in sweep() if r.method == "joint"]
    others = ("weighted", "paper, 1 / distance")
    theirs = [replace(r, method=name, radial_m=3 * r.radial_m) for r in joint for name in others]
    conclusions = conclude_yaw([*joint, *theirs])
    halves = [one for one in conclusions.checks if "rms radial error over all" in one.told]
    assert [(one.holds, one.measured) for one in halves] == [(True, "0.333")] * 2
    worse = [replace(r, radial_m=4 * r.radial_m) if r.layout == "two" else r for r in joint]
    again = conclude_yaw([*worse, *theirs])
    assert check(again, "2 or more markers").holds is False
    table = next(one for one in again.tables if one.name == "seed002_halves")
    assert [row[-1] for row in table.rows] == [0.333, 1.33, 0.333, 0.333, 0.333]


def test_a_difference_within_the_noise_is_no_trend() -> None:
    rows = [replace(r, radial_m=0.01 + 1e-5 * r.repeat) for r in sweep()]
    trends = [one for one in conclude_yaw(rows).checks if one.told.startswith("trend")]
    assert len(trends) == 5
    assert not any(one.holds for one in trends)


def test_every_figure_of_the_paper_is_there() -> None:
    pytest.importorskip("matplotlib")
    leaning = [
        replace(r, layout="one", **{axis: float(lean)})
        for r in sweep()
        if r.layout == "one"
        for axis in ("pitch_deg", "roll_deg")
        for lean in (-30, 0, 30)
    ]
    figures = [*conclude_yaw(sweep()).figures, *conclude_tilt(leaning).figures]
    numbers = {int(f.name.removeprefix("seed002_figure")) for f in figures if "figure" in f.name}
    assert numbers == {4, 5, 6, 8, 9, 11, 12, 14, 16, 17, 18, 20, 22, 23, 24, 25}
    for figure in figures:
        if figure.name in ("seed002_figure4", "seed002_figure25"):
            assert figure.draw().axes


def test_leaning_is_better_where_it_is() -> None:
    rows = [
        row(
            pitch_deg=float(lean),
            distance_m=float(d),
            repeat=n,
            radial_m=(0.01 + 0.001 * n) * (1 if lean else 3),
        )
        for lean in (-30, 0, 30)
        for d in (4, 5)
        for n in range(4)
    ]
    rows += [
        replace(r, pitch_deg=0.0, roll_deg=r.pitch_deg, radial_m=3 * r.radial_m)
        for r in rows
        if r.pitch_deg
    ]
    conclusions = conclude_tilt(rows)
    assert check(conclusions, "in pitch").holds is True
    assert check(conclusions, "in roll").measured.startswith("0 ±")
    assert check(conclusions, "in roll").holds is False


def test_zones_are_held_against_their_own_numbers() -> None:
    printed = seed002().zones
    rows = [
        row(
            zone=zone,
            repeat=n,
            assumed=assumed,
            radial_m=printed.radial_cm[zone] / 200,
            xy_m=printed.xy_mm[zone] / 2000,
            z_m=-printed.z_cm[zone] / 200,
            sd_radial_m=1e-3,
        )
        for zone in range(9)
        for n in range(3)
        for assumed in ("right", "size")
    ]
    conclusions = conclude_zones(rows)
    assert [one.holds for one in conclusions.checks] == [True, True, True]
    rows = [replace(r, xy_m=0.003) if r.zone == 8 else r for r in rows]
    assert check(conclude_zones(rows), "XY").holds is False
    noisy = [replace(r, sd_radial_m=0.05) for r in rows]
    assert check(conclude_zones(noisy), "XY").holds is None


def test_the_statements_are_those_of_the_text() -> None:
    stated = seed002()
    assert np.ptp(stated.zones.radial_cm) == pytest.approx(0.71)  # "the biggest one of 7,1 mm"
    for n in range(9):  # tables 1 and 2 agree with each other
        both_cm = math.hypot(stated.zones.xy_mm[n] / 10, stated.zones.z_cm[n])
        assert both_cm == pytest.approx(stated.zones.radial_cm[n], abs=0.07)
    assert {one.layout for one in stated.statements} == set(LAYOUTS)

"""Where an engine ends and what ours must hold follow from the rows."""

from dataclasses import replace

import numpy as np
import pytest

from tagmetry.lab.beside.detector_limits import conclude
from tagmetry.lab.beside.limit_summary import end_of, limits
from tagmetry.lab.rigs.limit_sweeps import SWEEPS
from tagmetry.lab.rows import Limit

GOOD = Limit("tagmetry", "side", 100.0, 0, 20, 20, 0, 0.011, 0.01, 8.0, 0.1, 0.2, 0, "")


def run(least_px: float, engine: str = "tagmetry", **told: object) -> list[Limit]:
    """Rows over all sides of an engine that finds those from one on."""
    return [
        replace(GOOD, engine=engine, value=value, found=20 if value >= least_px else 7, **told)
        for value in SWEEPS["side"].values
    ]


def check(rows: list[Limit], words: str) -> object:
    return next(one for one in conclude(rows).checks if words in one.told)


def test_an_engine_ends_before_the_first_value_that_is_too_hard() -> None:
    looks = limits(run(14.0)).looks("side", "tagmetry")
    assert str(end_of(looks)) == "14"
    assert str(end_of({**looks, 12.0: looks[100.0]})) == "12"
    gap = {**looks, 45.0: looks[8.0]}
    assert str(end_of(gap)) == "64"
    assert str(end_of({8.0: looks[8.0]})) == "nowhere"
    assert str(end_of(limits(run(1.0)).looks("side", "tagmetry"))) == "8*"


def test_repeats_are_weighed_by_what_was_found() -> None:
    rows = [GOOD, replace(GOOD, repeat=1, found=5, corner_rms_px=0.1, flips=1, distance2=20.0)]
    one = limits(rows).looks("side", "tagmetry")[100.0]
    assert one.recall == 25 / 40
    assert one.corner_px == pytest.approx(np.sqrt((20 * 0.011**2 + 5 * 0.1**2) / 25))
    assert one.distance2 == pytest.approx((20 * 8 + 5 * 20) / 25)
    assert one.flipped == 1 / 25


def test_what_was_never_found_has_no_error() -> None:
    nothing = replace(GOOD, found=0, corner_rms_px=np.nan, distance2=np.nan)
    one = limits([nothing]).looks("side", "tagmetry")[100.0]
    assert (one.recall, one.false_positives) == (0, 0)
    assert np.isnan([one.corner_px, one.distance2, one.flipped]).all()


def test_the_table_says_how_far() -> None:
    rows = [*run(12.0), *run(32.0, "apriltag", distance2=np.nan)]
    table = conclude(rows).tables[0]
    assert table.header == ("engine", "smallest, px")
    assert table.rows == (("tagmetry", "12"), ("apriltag", "32"))
    exact = conclude(rows).tables[1]
    assert exact.header == ("side, px", "bound px", "tagmetry", "apriltag")
    assert exact.rows[-1] == (8.0, 0.01, "0.011 (35)", "0.011 (35)")


def test_what_ours_must_hold() -> None:
    rows = [*run(12.0), *run(32.0, "apriltag", distance2=np.nan)]
    assert all(one.holds for one in conclude(rows).checks)
    off = [replace(row, corner_rms_px=0.014) if row.value == 45 else row for row in rows]
    assert check(off, "near the bound").measured == "1.10 in the middle, 1.40 at worst (side 45)"
    assert check(off, "near the bound").holds is False
    timid = [replace(row, distance2=5.0) if row.value == 64 else row for row in rows]
    assert check(timid, "covariances are right").holds is False
    blind = [*run(20.0), *run(12.0, "apriltag")]
    assert check(blind, "no fewer").measured == "65 % fewer than apriltag at side 17"
    wrong = [replace(GOOD, false_positives=1)]
    assert check(wrong, "where there is none").holds is False


def test_markers_that_are_not_found_do_not_count_against_the_bound() -> None:
    rows = [*run(12.0), replace(GOOD, value=8.0, found=1, corner_rms_px=1.0)]
    assert check(rows, "near the bound").holds is True


def test_without_ours_there_is_nothing_to_hold() -> None:
    assert conclude(run(20.0, "apriltag")).checks == ()


def test_an_engine_that_fails_is_named() -> None:
    rows = [*run(12.0), replace(GOOD, engine="locus", found=0, failure="crashed (SIGABRT)")]
    assert "locus gave no answer to some pictures: crashed (SIGABRT)" in conclude(rows).remarks


def test_figures_are_drawn() -> None:
    pytest.importorskip("matplotlib")
    rows = [*run(12.0), *run(32.0, "apriltag", distance2=np.nan)]
    (one,) = conclude(rows).figures
    axes = one.draw().axes[0]
    lines = {line.get_label(): line for line in axes.get_lines()}
    np.testing.assert_allclose(lines["Cramér-Rao bound"].get_ydata(), 0.01)
    assert {"tagmetry", "apriltag"} < set(lines)

"""Goals follow from the rows, by hand."""

import pytest

from tagmetry.lab.bench import Results, Row
from tagmetry.lab.bench.goals import Goal, goals
from tagmetry.lab.bench.machine import this_machine


def row(case: str, engine: str, threads: int = 1, **more: object) -> Row:
    return Row(case, engine, threads, "processor", 2.0, **more)


def reached(*rows: Row) -> list[Goal]:
    return goals(Results(this_machine(), "tag36h11", rows))


def test_the_fastest_peer_is_one_that_finds_all() -> None:
    (time, recall) = reached(
        row("count-24", "tagmetry", p50_ms=3.0, found=24, expected=24),
        row("count-24", "hasty", p50_ms=1.0, found=20, expected=24),
        row("count-24", "locus", p50_ms=20.0, found=24, expected=24),
        row("count-24", "tagmetry-track", p50_ms=0.1, found=24, expected=24),
    )
    assert time.measured == pytest.approx(0.15)
    assert time.holds
    assert recall.holds


def test_recall_is_that_of_the_best_peer() -> None:
    (recall,) = reached(
        row("side-20", "tagmetry", found=22, expected=24),
        row("side-20", "a", found=21, expected=24),
        row("side-20", "b", found=23, expected=24),
    )
    assert (recall.wanted, recall.holds) == (pytest.approx(23 / 24), False)


def test_corners_are_held_against_the_bound_and_the_best_peer() -> None:
    (bound, peer) = reached(
        row("gamma-60", "tagmetry", corner_rms_px=0.011, bound_px=0.005),
        row("gamma-60", "a", corner_rms_px=0.2),
        row("gamma-60", "b", corner_rms_px=0.05),
    )
    assert bound.wanted == pytest.approx(0.0105)
    assert not bound.holds
    assert peer.measured == pytest.approx(0.22)


def test_the_tracker_is_held_against_the_detector_and_the_clock() -> None:
    (share, rate) = reached(
        row("film-24", "tagmetry", p50_ms=8.0),
        row("film-24", "tagmetry-track", p50_ms=1.0),
        row("film-360", "tagmetry-track", threads=4, p50_ms=20.0),
    )
    assert (share.measured, share.holds) == (0.125, True)
    assert (rate.measured, rate.holds) == (50.0, False)


def test_stated_covariances_are_judged_over_all_markers() -> None:
    (goal,) = reached(
        row("side-30", "tagmetry", distance2=8.0, found=30),
        row("gamma-60", "tagmetry", distance2=12.0, found=10),
    )
    assert goal.measured == pytest.approx(1.0)
    assert goal.holds


def test_a_false_positive_is_one_too_many() -> None:
    assert [goal.holds for goal in reached(row("none", "tagmetry"))] == [True]
    assert [goal.holds for goal in reached(row("none", "tagmetry", false_positives=1))] == [False]


def test_nothing_measured_promises_nothing() -> None:
    assert reached() == []
    assert reached(row("count-24", "tagmetry", failure="crashed (SIGSEGV)")) == []

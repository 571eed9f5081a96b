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
    case = "exact-60-20dB-gamma"
    (bound, peer) = reached(
        row(case, "tagmetry", corner_rms_px=0.011, bound_px=0.005),
        row(case, "a", corner_rms_px=0.2),
        row(case, "b", corner_rms_px=0.05),
    )
    assert bound.wanted == pytest.approx(0.0105)
    assert bound.verdict == "falls short"
    assert (peer.measured, peer.bound) == (pytest.approx(0.22), pytest.approx(0.1))
    assert peer.verdict == "falls short"


def test_what_the_bound_forbids_is_said() -> None:
    case = "exact-30-20dB-gamma"
    (bound, peer) = reached(
        row(case, "tagmetry", corner_rms_px=0.021, bound_px=0.02),
        row(case, "a", corner_rms_px=0.08),
    )
    assert bound.verdict == "holds"
    assert peer.verdict == "beyond the bound"


def test_linear_cameras_are_not_held_against_peers() -> None:
    (bound,) = reached(
        row("exact-30-20dB", "tagmetry", corner_rms_px=0.021, bound_px=0.02),
        row("exact-30-20dB", "a", corner_rms_px=0.01),
    )
    assert bound.name == "exact-30-20dB: corners, px"


def test_the_tracker_is_held_against_the_detector_and_the_clock() -> None:
    (share, rate) = reached(
        row("film-24", "tagmetry", p50_ms=8.0),
        row("film-24", "tagmetry-track", p50_ms=1.0),
        row("film-360", "tagmetry-track", threads=4, p50_ms=20.0),
    )
    assert (share.measured, share.holds) == (0.125, True)
    assert (rate.measured, rate.holds) == (50.0, False)


def test_stated_covariances_are_judged_case_by_case() -> None:
    goals_of_all = reached(
        row("exact-30-20dB", "tagmetry", distance2=7.1),
        row("exact-60-40dB-gamma", "tagmetry", distance2=9.2),
    )
    assert [goal.measured for goal in goals_of_all] == pytest.approx([0.9, 1.2])
    assert [goal.holds for goal in goals_of_all] == [True, False]


def test_a_false_positive_is_one_too_many() -> None:
    assert [goal.holds for goal in reached(row("none", "tagmetry"))] == [True]
    assert [goal.holds for goal in reached(row("none", "tagmetry", false_positives=1))] == [False]


def test_small_families_are_held_against_a_third_of_opencvs() -> None:
    def goal(ours: int, theirs: int) -> Goal:
        case = "free-4x4_1000"
        (one,) = reached(
            row(case, "tagmetry", false_positives=ours),
            row(case, "opencv-none", false_positives=theirs),
            row(case, "opencv-subpix", false_positives=99),
        )
        return one

    assert goal(1, 4).holds
    assert not goal(2, 4).holds
    assert reached(row("free-4x4_1000", "tagmetry")) == []


def test_hostile_images_are_held_against_the_clock() -> None:
    (false, slowest) = reached(row("hostile", "tagmetry", p99_ms=251.0))
    assert false.holds
    assert not slowest.holds


def test_nothing_measured_promises_nothing() -> None:
    assert reached() == []
    assert reached(row("count-24", "tagmetry", failure="crashed (SIGSEGV)")) == []

"""Whole runs with tiny cases and engines that behave badly; costs, files and comparisons."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import fake_engines
import numpy as np
import pytest
from fake_engines import SQUARE_PX, kind

from tagmetry.errors import InputError
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.lab.bench import (
    Pace,
    Results,
    Row,
    Step,
    bench,
    compared,
    load_results,
    own_pictures,
    real_sets,
    save_results,
)
from tagmetry.lab.bench.case import Case, Truth
from tagmetry.lab.bench.costs import costs
from tagmetry.lab.bench.machine import this_machine
from tagmetry.lab.bench.real import FREE_OF
from tagmetry.lab.bench.team import Team
from tagmetry.lab.engines import EngineKind, Patience

LIGHT = np.full((40, 40), 200, np.uint8)
NIGHT = np.zeros((40, 40), np.uint8)
PACE = Pace(least_rounds=3, most_rounds=5, limit_s=10.0, patience=Patience(5.0))
SEVEN = Truth(np.array([7]), SQUARE_PX[None])


@dataclass(frozen=True, eq=False)
class Ready:
    """A case that is there already."""

    name: str
    images: tuple[GreyPixels, ...]
    family: str = "tag36h11"
    all_threads: bool = False

    def case(self) -> Case:
        return Case(self.name, self.family, self.images, (SEVEN,) * len(self.images))


def run(works: Sequence[Ready], kinds: Sequence[EngineKind], pace: Pace = PACE) -> list[Results]:
    return list(bench([Step(work, 1) for work in works], kinds, "tag36h11", pace))


def row(case: str = "a", engine: str = "tagmetry", **more: object) -> Row:
    return Row(case, engine, 1, "processor", 2.0, **more)


def results(*rows: Row) -> Results:
    return Results(this_machine(), "tag36h11", rows)


def test_gives_the_results_so_far_after_every_case() -> None:
    works = [Ready("first", (NIGHT,)), Ready("second", (NIGHT, NIGHT))]
    first, both = run(works, [kind(fake_engines.Good)])
    assert [one.case for one in first.rows] == ["first"]
    assert [one.case for one in both.rows] == ["first", "second"]
    assert both.rows[1].rounds == 5
    assert (both.rows[1].found, both.rows[1].expected) == (2, 2)
    assert both.rows[1].corner_rms_px == 0.0


def test_who_crashes_is_a_row_and_comes_back_for_the_next_case() -> None:
    kinds = [kind(fake_engines.Good, "good"), kind(fake_engines.DiesOnDark, "bad")]
    *_, last = run([Ready("night", (NIGHT,)), Ready("light", (LIGHT,))], kinds)
    night, light = last.of("night", "bad", 1), last.of("light", "bad", 1)
    assert night.failure.startswith("crashed")
    assert light.failure is None
    assert light.rounds == 5
    assert last.of("night", "good", 1).found == 1


def test_who_hangs_is_ended_and_the_others_go_on() -> None:
    kinds = [kind(fake_engines.HangsOnDark, "bad"), kind(fake_engines.Good, "good")]
    *_, last = run([Ready("night", (NIGHT,))], kinds, replace(PACE, patience=Patience(0.3, 1.0)))
    assert last.of("night", "bad", 1).failure == "no answer in 1 s"
    assert last.of("night", "good", 1).rounds == 5


@dataclass(frozen=True, eq=False)
class Once(Ready):
    """A case whose images are looked at once."""

    def case(self) -> Case:
        return replace(super().case(), once=True)


def test_where_time_is_not_asked_for_images_are_looked_at_once() -> None:
    *_, last = run([Once("many", (LIGHT,) * 2)], [kind(fake_engines.Good)])
    assert (last.rows[0].rounds, last.rows[0].expected) == (2, 2)


def test_engines_of_another_family_end() -> None:
    works = [Ready("one", (LIGHT,)), Ready("other", (LIGHT,), family="4x4_50")]
    good = replace(kind(fake_engines.Good), families=None)
    with Team([good], 1, PACE.patience) as team:
        first, second = (team.members(work.case())[0] for work in works)
        assert second.show((LIGHT,)) is None
        with pytest.raises(ValueError, match="closed"):
            first.show((LIGHT,))


def test_an_engine_rests_when_it_was_measured_enough() -> None:
    *_, last = run([Ready("light", (LIGHT,))], [kind(fake_engines.Good)], replace(PACE, limit_s=0))
    assert last.rows[0].rounds == 3


def test_who_does_not_know_the_family_does_not_run() -> None:
    stranger = replace(kind(fake_engines.Good, "stranger"), families=frozenset({"4x4_50"}))
    *_, last = run([Ready("light", (LIGHT,))], [kind(fake_engines.Good), stranger])
    assert [one.engine for one in last.rows] == ["fake"]


def test_trackers_run_on_films_only() -> None:
    tracker = kind(fake_engines.Good, "tracker", tracks=True)
    (only,) = run([Ready("light", (LIGHT,))], [tracker])
    assert only.rows == ()


def test_costs_are_those_that_the_times_were_made_of() -> None:
    rows = [
        replace(row(f"{size}-{n}"), megapixels=size, expected=n, p50_ms=0.5 + 3 * size + 0.2 * n)
        for size in (0.3, 1.0, 2.0)
        for n in (1, 24)
    ]
    (cost,) = costs(rows, {one.case for one in rows})
    assert cost.image_ms == pytest.approx(0.5)
    assert cost.megapixel_ms == pytest.approx(3.0)
    assert cost.marker_ms == pytest.approx(0.2)
    assert cost.misfit_percent == pytest.approx(0.0, abs=1e-6)


def test_costs_need_cases_that_differ() -> None:
    rows = [replace(row(name), p50_ms=1.0, expected=5) for name in "abc"]
    assert costs(rows, set("abc")) == []
    assert costs(rows, {"a"}) == []


def test_results_come_back_from_a_file(tmp_path: Path) -> None:
    made = results(row(p50_ms=1.5, corner_rms_px=0.01), row("b", failure="crashed (SIGSEGV)"))
    save_results(made, tmp_path / "out.json")
    assert load_results(tmp_path / "out.json") == made


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "this is not JSON"),
        ("[1, 2]", "no result of `tagmetry bench`"),
        ("{}", "no result of `tagmetry bench`: machine"),
        ('{"machine": 3, "family": "x"}', "machine: "),
        ('{"a": NaN}', "finite"),
    ],
)
def test_refuses_what_is_no_result(tmp_path: Path, content: str, said: str) -> None:
    path = tmp_path / "old.json"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=said) as refusal:
        load_results(path)
    assert str(path) in str(refusal.value)


def test_refuses_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"old.json: No such file"):
        load_results(tmp_path / "old.json")


def test_compares_what_is_in_both() -> None:
    engines = ("tagmetry", "tagmetry-track", "locus")
    before = [row(engine=name, p50_ms=10.0) for name in engines]
    now = [row(engine=name, p50_ms=t) for name, t in zip(engines, (2.5, 1.0, 12.0), strict=True)]
    comparison = compared(
        results(*now, row("new", p50_ms=1.0)), results(*before, row("gone", p50_ms=1.0))
    )
    times = {change.now.engine: change.time for change in comparison.changes}
    assert times == {"tagmetry": 0.25, "tagmetry-track": 0.1, "locus": 1.2}
    (note,) = comparison.notes
    assert note.startswith("the peers took 1.20 of their former time (median)")


def test_another_machine_and_other_versions_are_said() -> None:
    before = results(row(p50_ms=4.0))
    packages = {**before.machine.packages, "numpy": "1.0"}
    machine = replace(before.machine, processor="abacus", packages=packages)
    notes = compared(results(row(p50_ms=4.0)), replace(before, machine=machine)).notes
    assert any(note.startswith("other machine: abacus, ") for note in notes)
    assert any(note.startswith("numpy 1.0 before, ") for note in notes)


def test_refuses_runs_that_have_nothing_in_common() -> None:
    with pytest.raises(InputError, match="none of these cases"):
        compared(results(row("a")), results(row("b")))


def test_own_pictures_become_a_case(tmp_path: Path) -> None:
    for name, size in (("a.png", (40, 30)), ("b.png", (20, 50))):
        cv2.imwrite(str(tmp_path / name), np.full(size, 9, np.uint8))
    case = own_pictures([str(tmp_path / "*.png")], "4x4_50").case()
    assert [image.shape for image in case.images] == [(40, 30), (20, 50)]
    assert (case.name, case.family, case.truths) == ("own", "4x4_50", None)


def test_our_own_detector_knows_every_family() -> None:
    ours = replace(kind(fake_engines.Good), families=None)
    (only,) = run([Ready("light", (LIGHT,), family="tag36h11_border2")], [ours])
    assert only.rows[0].engine == "fake"


def test_of_many_pictures_some_are_taken_and_the_name_says_so(tmp_path: Path) -> None:
    for number in range(30):
        (tmp_path / f"{number}.png").touch()
    one = own_pictures([str(tmp_path)], "tag36h11")
    assert one.name == "own-24-of-30"
    assert (one.paths[0].name, one.paths[-1].name) == ("0.png", "29.png")


def test_refuses_a_picture_that_is_none(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"no picture")
    with pytest.raises(InputError, match=r"a\.png: "):
        own_pictures([str(tmp_path / "a.png")], "tag36h11").case()


def test_refuses_a_picture_too_small_by_its_name(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "a.png"), np.full((1, 1), 9, np.uint8))
    with pytest.raises(InputError, match=r"a\.png: .* 1x1 pixels is too small"):
        own_pictures([str(tmp_path / "a.png")], "tag36h11").case()


def test_refuses_a_data_folder_without_sets(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none of the sets tiny_tags, "):
        real_sets(tmp_path)


def test_pictures_without_markers_have_a_truth(tmp_path: Path) -> None:
    (tmp_path / "marker_free").mkdir()
    cv2.imwrite(str(tmp_path / "marker_free" / "a.jpg"), LIGHT)
    sets = real_sets(tmp_path)
    assert [one.name for one in sets] == [f"free-{name}" for name in FREE_OF]
    case = sets[-1].case()
    assert case.once
    assert case.family == FREE_OF[-1]
    assert [len(truth.ids) for truth in case.truths] == [0]

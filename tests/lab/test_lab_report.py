"""The page holds everything, needs nothing from elsewhere, and shows texts as they are."""

import re
from pathlib import Path

import pytest
from seed003_rows import positions
from small_experiment import SMALL, threads

from tagmetry.errors import InputError
from tagmetry.lab.conclusions import Check
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.registry import experiment, experiment_names
from tagmetry.lab.report import Chapter, check_lines, page, write_report
from tagmetry.lab.report.chapter import chapter
from tagmetry.lab.results import Origin, write_rows
from tagmetry.lab.rows import Position
from tagmetry.lab.sweep import Sweep, run

pytest.importorskip("pyarrow")
pytest.importorskip("matplotlib")
ORIGIN = Origin("seed003-pose", "1", 0, True, ("{}",))


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("results")
    write_rows(folder / "seed003-pose.parquet", positions(0.001), Position, ORIGIN)
    return folder


def test_the_page_has_all_and_needs_nothing_from_elsewhere(home: Path) -> None:
    write_report(home, home / "report.html")
    text = (home / "report.html").read_text("utf-8")
    assert [int(n) for n in re.findall(r"id='seed003_figure(\d+)'", text)] == list(range(10, 24))
    for n in range(7, 16):
        assert f">Table {n}: " in text
    assert "18 of 18 checks hold" in text
    assert "(not run: tagmetry lab run seed003-calibration)" in text
    assert "<script" not in text
    assert set(re.findall(r"(?:src|href)='([^#d])", text)) == set()


def test_texts_are_shown_as_they_are(tmp_path: Path) -> None:
    sweep = Sweep(SMALL, tmp_path)
    list(run(sweep, threads()))
    sweep.gather()
    text = page([chapter(SMALL, tmp_path)])
    assert "a &lt;number&gt;" in text
    assert "a &amp; b" in text
    assert "A full run of 5 cases, seed 0" in text


def test_an_experiment_that_was_not_run_has_no_conclusions(tmp_path: Path) -> None:
    assert chapter(SMALL, tmp_path) == Chapter(SMALL)


def test_a_folder_without_results_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"has no results; `tagmetry lab run` makes them"):
        write_report(tmp_path, tmp_path / "report.html")


def test_a_broken_result_is_refused(tmp_path: Path) -> None:
    (tmp_path / "seed003-pose.parquet").write_bytes(b"no")
    with pytest.raises(InputError, match=r"seed003-pose.parquet: no whole result"):
        write_report(tmp_path, tmp_path / "report.html")


def test_checks_in_lines() -> None:
    checks = [Check("a", "1", "2", holds) for holds in (True, False, None)]
    assert [line[:6] for line in check_lines(checks)] == ["holds ", "FAILS ", "-     "]


def test_an_unknown_experiment_is_refused_with_those_there_are() -> None:
    with pytest.raises(InputError, match=r"there is no experiment 'seed9'; there are seed00"):
        experiment("seed9")


@pytest.mark.parametrize("name", experiment_names())
def test_every_experiment_knows_its_name_and_has_few_quick_cases(name: str) -> None:
    about: Experiment = experiment(name)
    assert about.name == name
    quick, full = about.cases(True), about.cases(False)
    assert 0 < len(quick) <= len(full)
    assert len(set(full)) == len(full)

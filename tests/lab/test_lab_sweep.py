"""Every case is measured once, kept at once, and never mixed with another setting's."""

import errno
import os
from collections import Counter
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_experiment import SMALL, Case, Row, measure, threads, traced

from tagmetry import __version__
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.lab.results import Origin, read_origin, read_rows, write_rows
from tagmetry.lab.sweep import Sweep, Workers, cluster_workers, local_workers, run
from tagmetry.lab.sweep.measuring import Measured
from tagmetry.lab.sweep.name import _source, case_name, case_seed

pytest.importorskip("pyarrow")


def measured(folder: Path) -> Counter:
    """How often each case was measured."""
    return Counter(int(trace.name.split("-")[0]) for trace in folder.iterdir())


@pytest.fixture
def traces(tmp_path: Path) -> Path:
    folder = tmp_path / "traces"
    folder.mkdir()
    return folder


def test_all_cases_are_measured_by_processes_and_gathered_in_order(tmp_path: Path) -> None:
    sweep = Sweep(SMALL, tmp_path / "out")
    with local_workers(2) as workers:
        assert set(run(sweep, workers)) == set(sweep.cases)
    rows = read_rows(sweep.gather(), Row)
    assert [row.number for row in rows] == [0, 0, 1, 1, 2, 2, 3, 3, 4, 4]
    assert os.getpid() not in {row.process for row in rows}
    alone = [measure(case, case_seed(SMALL, case, 0))[0].drawn for case in sweep.cases]
    assert [row.drawn for row in rows[::2]] == alone
    assert np.isnan([row.drawn for row in rows[1::2]]).all()


def test_results_tell_how_they_came_about(tmp_path: Path) -> None:
    sweep = Sweep(SMALL, tmp_path, seed=3, quick=True)
    list(run(sweep, threads()))
    settings = tuple(
        f'{{"fault": "", "name": "case {n}", "number": {n}, "trace": ""}}' for n in range(2)
    )
    assert read_origin(sweep.gather()) == Origin("small", __version__, 3, True, settings)


def test_an_interrupted_sweep_loses_nothing_and_repeats_nothing(
    tmp_path: Path, traces: Path
) -> None:
    sweep = Sweep(traced(traces), tmp_path / "out")
    with closing(run(sweep, threads(2))) as running:
        next(running)
    begun = measured(traces)
    assert 1 <= len(begun) < 5
    assert {case.number for case in sweep.unfinished()} == set(range(5)) - set(begun)
    list(run(sweep, threads()))
    assert measured(traces) == Counter(range(5))
    assert len(read_rows(sweep.gather(), Row)) == 10


def test_a_finished_sweep_measures_nothing(tmp_path: Path, traces: Path) -> None:
    sweep = Sweep(traced(traces), tmp_path / "out")
    list(run(sweep, threads()))
    assert list(run(sweep, threads())) == []
    assert measured(traces) == Counter(range(5))


def test_a_full_run_uses_what_the_quick_one_measured(tmp_path: Path) -> None:
    list(run(Sweep(SMALL, tmp_path, quick=True), threads()))
    assert [case.number for case in Sweep(SMALL, tmp_path).unfinished()] == [2, 3, 4]


def test_other_settings_seeds_and_versions_are_other_cases(monkeypatch) -> None:
    case = Case("case", 1)
    name = case_name(SMALL, case, 0)
    assert name == case_name(SMALL, Case("case", 1), 0)
    others = {
        case_name(SMALL, replace(case, number=2), 0),
        case_name(SMALL, case, 1),
        case_name(replace(SMALL, name="other"), case, 0),
    }
    monkeypatch.setattr("tagmetry.lab.sweep.name.__version__", "99")
    others.add(case_name(SMALL, case, 0))
    monkeypatch.undo()
    monkeypatch.setattr("tagmetry.lab.sweep.name._source", lambda _: "another text")
    others.add(case_name(SMALL, case, 0))
    assert len(others - {name}) == 5


def test_random_numbers_follow_seed_and_settings_alone(monkeypatch) -> None:
    case = Case("case", 1)
    seed = case_seed(SMALL, case, 0)
    monkeypatch.setattr("tagmetry.lab.sweep.name.__version__", "99")
    assert case_seed(SMALL, case, 0) == seed
    assert len({seed, case_seed(SMALL, case, 1), case_seed(SMALL, Case("case", 2), 0)}) == 3


def test_a_case_that_cannot_be_measured_is_named_and_the_others_are_kept(
    tmp_path: Path, traces: Path
) -> None:
    sweep = Sweep(traced(traces, fault_2="input"), tmp_path / "out")
    with pytest.raises(InputError, match=r'small .*"number": 2.*: the lamp is off'):
        list(run(sweep, threads()))
    assert {case.number for case in sweep.unfinished()} == {2, 3, 4}


def test_a_worker_that_dies_is_told(tmp_path: Path, traces: Path) -> None:
    sweep = Sweep(traced(traces, fault_1="death"), tmp_path / "out", quick=True)
    with (
        pytest.raises(InputError, match=r"a worker died.*run the same command again"),
        local_workers(1) as workers,
    ):
        list(run(sweep, workers))
    assert [case.number for case in sweep.unfinished()] == [1]


class Outdated(ThreadPoolExecutor):
    """A worker with an older version installed."""

    def submit(self, *_: object) -> Future:
        return super().submit(Measured, "0.0.1", [])


def test_a_worker_of_another_version_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"a worker has tagmetry 0\.0\.1, this is .*same version"):
        list(run(Sweep(SMALL, tmp_path), Workers(Outdated(1), 1)))
    assert len(Sweep(SMALL, tmp_path).unfinished()) == 5


@pytest.mark.parametrize("content", [b"", b"PAR1 no more", b"{}"])
def test_a_broken_file_of_a_case_is_named(tmp_path: Path, content: bytes) -> None:
    sweep = Sweep(SMALL, tmp_path)
    list(run(sweep, threads()))
    part = next((tmp_path / "cases" / "small").iterdir())
    part.write_bytes(content)
    with pytest.raises(InputError, match=f"{part.name}: no whole result .* delete it and run"):
        sweep.gather()


def test_a_truncated_result_is_refused(tmp_path: Path) -> None:
    sweep = Sweep(SMALL, tmp_path)
    list(run(sweep, threads()))
    whole = sweep.gather().read_bytes()
    sweep.result.write_bytes(whole[: len(whole) // 2])
    for read in (read_origin, lambda path: read_rows(path, Row)):
        with pytest.raises(InputError, match=r"small.parquet: no whole result"):
            read(sweep.result)


def test_a_parquet_file_of_others_is_refused(tmp_path: Path) -> None:
    import pyarrow as pa
    from pyarrow.parquet import write_table

    path = tmp_path / "other.parquet"
    write_table(pa.table({"name": ["a"], "number": pa.array([None], pa.int64())}), path)
    with pytest.raises(InputError, match="no whole result"):
        read_origin(path)
    with pytest.raises(InputError, match="no whole result"):
        read_rows(path, Row)


def test_a_full_disk_is_one_line_and_what_is_finished_is_kept(tmp_path: Path, monkeypatch) -> None:
    sweep = Sweep(SMALL, tmp_path)
    with closing(run(sweep, threads())) as running:
        next(running)
    kept = len(sweep.unfinished())

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr("tagmetry.files.atomic.os.fsync", full)
    with pytest.raises(InputError, match=r"cannot write .*: No space left on device; .*is kept"):
        list(run(sweep, threads()))
    assert len(sweep.unfinished()) == kept
    assert not list(tmp_path.rglob("*.tmp"))


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="cannot make the folder"):
        list(run(Sweep(SMALL, tmp_path / "file"), threads()))


def test_rows_come_back_as_they_were(tmp_path: Path) -> None:
    rows = [Row("ü", -1, 1 / 3, 2**40, True), Row("", 0, float("inf"), 0, False)]
    write_rows(tmp_path / "a.parquet", rows, Row, Origin("small", "1", 0, False, ()))
    assert read_rows(tmp_path / "a.parquet", Row) == rows


def test_processes_have_one_thread_each(tmp_path: Path) -> None:
    before = dict(os.environ)
    with local_workers(1) as workers:
        assert workers.executor.submit(os.getenv, "OMP_NUM_THREADS").result() == "1"
    assert dict(os.environ) == before


def test_without_dask_the_extra_is_named(monkeypatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "distributed", None)
    with (
        pytest.raises(MissingExtraError, match=r"tagmetry\[cluster\]"),
        cluster_workers("tcp://127.0.0.1:1"),
    ):
        pass


def test_the_text_of_an_experiment_and_of_its_own_rigs_counts() -> None:
    text = _source("tagmetry.lab.experiments.seed003_pose")
    assert "def board_poses()" in text  # of a rig's rig
    assert "def solved_webcam(" in text
    assert "class Stand" not in text  # of another experiment's


def test_results_that_are_not_there_are_asked_for(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.parquet: there is no such result .* run"):
        read_rows(tmp_path / "none.parquet", Row)

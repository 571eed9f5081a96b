"""The same sweep on a Dask cluster of two workers that are processes of their own."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from small_experiment import SMALL, Row, threads

from tagmetry.errors import InputError
from tagmetry.lab.results import read_rows
from tagmetry.lab.sweep import Sweep, cluster_workers, run

distributed = pytest.importorskip("distributed")
pytest.importorskip("pyarrow")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    )
    with cluster:
        yield cluster.scheduler_address


def test_two_processes_measure_what_one_would(address: str, tmp_path: Path) -> None:
    there, here = Sweep(SMALL, tmp_path / "there"), Sweep(SMALL, tmp_path / "here")
    with cluster_workers(address) as workers:
        assert workers.count == 2
        list(run(there, workers))
    list(run(here, threads()))
    rows = read_rows(there.gather(), Row)
    own = read_rows(here.gather(), Row)
    assert [row.drawn for row in rows[::2]] == [row.drawn for row in own[::2]]
    processes = {row.process for row in rows}
    assert len(processes) == 2
    assert os.getpid() not in processes


@pytest.mark.parametrize("nowhere", ["tcp://127.0.0.1:1", "no address"])
def test_no_cluster_is_one_line(nowhere: str, monkeypatch) -> None:
    monkeypatch.setattr("tagmetry.lab.sweep.workers.PATIENCE_S", 1)
    with (
        pytest.raises(InputError, match=f"cannot reach a Dask cluster at {nowhere}; give"),
        cluster_workers(nowhere),
    ):
        pass

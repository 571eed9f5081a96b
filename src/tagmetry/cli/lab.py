"""`tagmetry lab`: the published experiments, run again and drawn beside the published figures."""

from collections.abc import Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.lab.sweep import Sweep, Workers

app = typer.Typer(
    help="The published experiments beside ours, with what must hold.", no_args_is_help=True
)

Out = Annotated[Path, typer.Option(help="Folder of the results.")]
_HOME = Path("lab-results")


@app.command(name="list")
def list_() -> None:
    """Name the experiments."""
    from tagmetry.lab.registry import experiment, experiment_names

    for about in map(experiment, experiment_names()):
        typer.echo(f"{about.name}: {about.title}\n    {about.source}")


@app.command()
def run(
    *,
    names: Annotated[
        list[str] | None, typer.Argument(metavar="NAME", help="Experiments that `lab list` names.")
    ] = None,
    all_: Annotated[bool, typer.Option("--all", help="All of them.")] = False,
    quick: Annotated[bool, typer.Option("--quick", help="Few cases, for a first look.")] = False,
    out: Out = _HOME,
    jobs: Annotated[
        int | None, typer.Option(min=1, help="Processes; by default one for each processor.")
    ] = None,
    cluster: Annotated[
        str | None, typer.Option(help="Scheduler of a Dask cluster: tcp://10.0.0.5:8786.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of all that is random.")] = 0,
) -> None:
    """Measure, keep every finished case, and say what holds; an interrupted run goes on."""
    from tagmetry.lab.registry import experiment
    from tagmetry.lab.results import require_parquet
    from tagmetry.lab.sweep import Sweep

    require_parquet()
    sweeps = [Sweep(experiment(name), out, seed, quick) for name in _wanted(names or [], all_)]
    with _workers(jobs, cluster) as workers:
        for sweep in sweeps:
            _run(sweep, workers)


@app.command()
def report(
    *,
    out: Out = _HOME,
    to: Annotated[
        Path | None, typer.Option(help="File of the page; by default report.html in the folder.")
    ] = None,
) -> None:
    """Write one page of all results, every published figure beside ours."""
    from tagmetry.lab.report import write_report

    path = to or out / "report.html"
    write_report(out, path)
    typer.echo(f"wrote {path}")


def _wanted(names: Sequence[str], all_: bool) -> Sequence[str]:
    from tagmetry.errors import InputError
    from tagmetry.lab.registry import experiment_names

    if bool(names) == all_:
        raise InputError(
            f"name the experiments to run, or give --all; there are {', '.join(experiment_names())}"
        )
    return names or experiment_names()


def _workers(jobs: int | None, cluster: str | None) -> "AbstractContextManager[Workers]":
    from tagmetry.errors import InputError
    from tagmetry.lab.sweep import cluster_workers, local_workers

    if cluster is None:
        return local_workers(jobs)
    if jobs is not None:
        raise InputError("--jobs is for this machine; a cluster's workers say how many they are")
    return cluster_workers(cluster)


def _run(sweep: "Sweep", workers: "Workers") -> None:
    """Run one experiment, and print what it says."""
    from tagmetry.cli.progress import counted
    from tagmetry.lab.report import check_lines
    from tagmetry.lab.report.chapter import chapter
    from tagmetry.lab.sweep import run as measured

    todo = len(sweep.unfinished())
    for _ in counted(measured(sweep, workers), todo, sweep.experiment.name):
        pass
    result = sweep.gather()
    count = len(sweep.cases)
    typer.echo(f"{sweep.experiment.name}: {todo} of {count} cases measured now -> {result}")
    told = chapter(sweep.experiment, sweep.home).conclusions
    for line in check_lines(told.checks):
        typer.echo(f"  {line}")

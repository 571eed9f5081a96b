"""`tagmetry bench`: all detectors on the same images, in one run."""

from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.lab.bench import Results, Work
    from tagmetry.lab.bench.setup import Extent
    from tagmetry.lab.engines import EngineKind


def bench(  # noqa: PLR0913 (each argument is an option)
    *,
    quick: Annotated[bool, typer.Option("--quick", help="Two cases, in seconds.")] = False,
    full: Annotated[bool, typer.Option("--full", help="All cases, for many rounds.")] = False,
    case: Annotated[
        list[str] | None,
        typer.Option(help="Only this case, or those that fit (side-*); several times."),
    ] = None,
    engine: Annotated[
        list[str] | None, typer.Option(help="Only this engine, and ours; several times.")
    ] = None,
    threads: Annotated[
        int | None,
        typer.Option(min=1, help="By default one, and some cases with all there are."),
    ] = None,
    family: Annotated[str, typer.Option(help="Family of the markers.")] = "tag36h11",
    real: Annotated[
        bool,
        typer.Option("--real", help="Real pictures too, of the folder that TAGMETRY_DATA names."),
    ] = False,
    images: Annotated[
        list[str] | None,
        typer.Option(help="Only your own pictures: a file, folder or pattern; several times."),
    ] = None,
    json: Annotated[Path | None, typer.Option(help="Write the results there.")] = None,
    picture: Annotated[Path | None, typer.Option(help="Draw the results there: .png.")] = None,
    compare: Annotated[
        Path | None, typer.Option(help="Results of a former run to compare with.")
    ] = None,
) -> None:
    """Measure time, recall and accuracy of our detector and its peers on the same images."""
    from tagmetry.cli.bench_report import check_outputs, tell
    from tagmetry.cli.progress import counted
    from tagmetry.lab.bench import PACES, load_results, save_results, steps
    from tagmetry.lab.bench import bench as measured

    check_outputs(json, picture)
    former = load_results(compare) if compare is not None else None
    extent = _extent(quick=quick, full=full)
    works = _works(extent, case or [], images or [], family, real=real)
    to_do = steps(works, _threads(threads, extent))
    results: Results | None = None
    with closing(measured(to_do, _kinds(engine), family, PACES[extent])) as runs:
        for results in counted(runs, len(to_do), "bench"):
            if json is not None:
                save_results(results, json)
    if results is not None:
        tell(results, former, picture)


def _extent(*, quick: bool, full: bool) -> "Extent":
    from tagmetry.errors import InputError

    if quick and full:
        raise InputError("expected --quick or --full, found both")
    return "quick" if quick else "full" if full else "default"


def _works(
    extent: "Extent", patterns: list[str], images: list[str], family: str, *, real: bool
) -> "list[Work]":
    """Return what to measure: one's own pictures, or rendered cases and on request real ones."""
    from tagmetry.errors import InputError
    from tagmetry.lab.bench import fitting, own_pictures, renderings

    if images and (patterns or real):
        raise InputError("--images measures your own pictures only: leave out --case and --real")
    if images:
        return [own_pictures(images, family)]
    works = renderings("full" if patterns else extent, family)
    if real:
        works += _real()
    return fitting(works, patterns) if patterns else works


def _real() -> "list[Work]":
    import os

    from tagmetry.errors import InputError
    from tagmetry.lab.bench import real_sets

    if "TAGMETRY_DATA" not in os.environ:
        raise InputError("--real needs the folder of real pictures: set TAGMETRY_DATA to it")
    return list(real_sets(Path(os.environ["TAGMETRY_DATA"])))


def _threads(wanted: int | None, extent: "Extent") -> list[int]:
    import os

    if wanted is not None:
        return [wanted]
    return [1] if extent == "quick" else sorted({1, os.cpu_count() or 1})


def _kinds(names: list[str] | None) -> "tuple[EngineKind, ...]":
    from tagmetry.lab.engines import chosen, installed

    return chosen(names) if names else installed()

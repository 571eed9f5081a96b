"""`tagmetry calibrate`: a camera with its covariance from pictures of a board."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import Json

if TYPE_CHECKING:
    from tagmetry.pipeline.board_pictures import Sighting
    from tagmetry.pipeline.calibration import CalibrationRun, Request


def calibrate(  # noqa: PLR0913 (each argument is an option)
    *,
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="SOURCE",
            help="Pictures of the board: folder, glob, video, camera number, rtsp://, http://, "
            "or a scene of the twin: twin:board-sweep, twin:desk.yaml.",
        ),
    ],
    board: Annotated[
        str,
        typer.Option(
            help="The board: chessboard:9x6:25mm (inner corners), "
            "charuco:7x5:30mm:22mm:5x5_100[:legacy] (squares), aprilgrid:6x6:88mm:0.3, "
            "grid:…, circles:…"
        ),
    ],
    out: Annotated[Path | None, typer.Option(help="Camera file to write.")] = None,
    model: Annotated[
        str,
        typer.Option(
            help="Lens: auto, none, brown1, brown2, brown4, brown5, brown8, brown12, brown14, "
            "fisheye."
        ),
    ] = "auto",
    shape: Annotated[
        str, typer.Option(help="flat: the board is as its maker says; free: it is solved too.")
    ] = "flat",
    fix_aspect: Annotated[bool, typer.Option("--fix-aspect", help="Hold fx = fy.")] = False,
    fix_center: Annotated[
        bool, typer.Option("--fix-center", help="Hold the principal point in the middle.")
    ] = False,
    report: Annotated[Path | None, typer.Option(help="Page with all figures: .html.")] = None,
    figures: Annotated[Path | None, typer.Option(help="Folder for the figures as PNG.")] = None,
    csv: Annotated[Path | None, typer.Option(help="Folder for the tables as CSV.")] = None,
    views: Annotated[
        int, typer.Option(min=3, help="Solve from so many views, those that tell most.")
    ] = 100,
    live: Annotated[
        bool, typer.Option("--live", help="Say where to hold the board, and take views.")
    ] = False,
    uncertainty: Annotated[
        str, typer.Option(help="With --live: end when so much is reached everywhere.")
    ] = "0.5px",
    measured: Annotated[
        str | None,
        typer.Option(
            help="By a ruler: 148mm (the pattern's width), or width=148mm,height=105mm, square=…, "
            "marker=…"
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Calibrate a camera, and say what the calibration is worth."""
    from tagmetry.cli.answer import answer
    from tagmetry.cli.calibrate_live import watched
    from tagmetry.cli.calibrate_report import run_lines, run_table

    request = _request(board, model, shape, views, measured)
    request = _held(request, fix_aspect=fix_aspect, fix_center=fix_center)
    _check_outputs(out, report)
    if live:
        seen = watched(sources, request.board, uncertainty, quiet=json)
    else:
        seen = tuple(_sightings(sources, request))
    run = _run(seen, request, board)
    _write(run, out, report, figures, csv)
    answer(json=json, table=lambda: run_table(run), lines=lambda: run_lines(run))


def _request(board: str, model: str, shape: str, views: int, measured: str | None) -> "Request":
    from tagmetry.errors import InputError
    from tagmetry.files.board_text import parse_board
    from tagmetry.pipeline.calibration import Request

    if shape not in ("flat", "free"):
        raise InputError(f"expected --shape flat or free, found {shape[:40]!r}")
    return Request(
        parse_board(board),
        _lens(model),  # type: ignore[arg-type]
        free_shape=shape == "free",
        most_views=views,
        measured_m=_measured_m(measured),
    )


def _held(request: "Request", *, fix_aspect: bool, fix_center: bool) -> "Request":
    from dataclasses import replace

    return replace(request, fix_aspect=fix_aspect, fix_center=fix_center)


def _lens(name: str) -> str:
    from tagmetry.calibrate.choice import LENS_NAMES
    from tagmetry.errors import InputError

    if name not in ("auto", *LENS_NAMES):
        raise InputError(f"expected --model auto, {', '.join(LENS_NAMES)}, found {name[:40]!r}")
    return name


def _measured_m(text: str | None) -> dict[str, float]:
    """Return lengths by name; one without a name is the width."""
    from tagmetry.errors import InputError
    from tagmetry.files.lengths import parse_length_m

    lengths_m: dict[str, float] = {}
    for part in text.split(",") if text else ():
        name, equals, length = part.rpartition("=")
        name = name.strip() if equals else "width"
        if name in lengths_m:
            raise InputError(f"--measured gives {name[:40]!r} twice; give one")
        lengths_m[name] = parse_length_m(length)
    return lengths_m


def _check_outputs(out: Path | None, report: Path | None) -> None:
    """Refuse before the work what could not be written after it."""
    from tagmetry.errors import InputError
    from tagmetry.files.atomic import check_destinations

    if report is not None and report.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"the report is a page: expected a name ending in .html, found {report}")
    check_destinations(out, report)


def _sightings(sources: list[str], request: "Request") -> "Iterator[Sighting]":
    from tagmetry.cli.progress import progress
    from tagmetry.errors import InputError
    from tagmetry.pipeline import open_images
    from tagmetry.pipeline.board_pictures import sightings

    for spec in sources:
        with open_images(spec) as source:
            if source.is_live:
                raise InputError(f"{source.name} has no end: add --live to take views from it")
            yield from sightings(progress(source), request.board)


def _run(seen: "tuple[Sighting, ...]", request: "Request", board: str) -> "CalibrationRun":
    """Return the calibration; where there is none, say first what the pictures show instead."""
    import datetime as dt

    from tagmetry import __version__
    from tagmetry.cli.calibrate_report import refusal_lines
    from tagmetry.pipeline.calibration import RefusedError, run_calibration, with_provenance

    try:
        run = run_calibration(seen, request)
    except RefusedError as error:
        for line in refusal_lines(error):
            typer.echo(line, err=True)
        raise
    today = dt.datetime.now(tz=dt.UTC).date().isoformat()
    return with_provenance(run, board, f"tagmetry {__version__}", today)


def _write(
    run: "CalibrationRun",
    out: Path | None,
    report: Path | None,
    figures: Path | None,
    csv: Path | None,
) -> None:
    from tagmetry.cli.interrupts import held_back
    from tagmetry.files import save_camera
    from tagmetry.record.calibration_report import write_figures, write_report, write_tables

    with held_back():
        if report is not None:
            write_report(run.facts, report)
        if figures is not None:
            write_figures(run.facts, figures)
        if csv is not None:
            write_tables(run.facts, csv)
        if out is not None:
            save_camera(run.calibration.camera, out)
    for path in filter(None, (out, report, figures, csv)):
        typer.echo(f"wrote {path}", err=True)

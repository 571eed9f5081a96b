"""`tagmetry arena audit`: how accurate the arena is, by a grid of markers laid on its floor."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.arena_options import ArenaFile, SourceName
from tagmetry.cli.options import CameraFile, first

if TYPE_CHECKING:
    from tagmetry.arena import AuditGrid, ErrorMap, GridPlace

_NEAR_M = 0.15


def audit(  # noqa: PLR0913 (each argument is an option)
    *,
    source: SourceName,
    arena: ArenaFile,
    grid: Annotated[str, typer.Option(help="Columns and rows of the grid of markers: 24x15.")],
    step: Annotated[str, typer.Option(help="From centre to centre: 68mm.")],
    size: Annotated[str, typer.Option(help="Side of the black squares: 50mm.")],
    camera: CameraFile = None,
    family: Annotated[str, typer.Option(help="Family of the grid's markers.")] = "tag36h11",
    first_id: Annotated[int, typer.Option(min=0, help="Id of the marker at the top left.")] = 0,
    height: Annotated[str, typer.Option(help="Of the markers above the floor.")] = "0",
    at: Annotated[
        str | None,
        typer.Option(
            help="Where the grid's middle lies: x,y,turn in metres and degrees; by default where "
            "it fits best, which hides errors that all markers share."
        ),
    ] = None,
    images: Annotated[int, typer.Option(min=1, help="At most so many images are averaged.")] = 10,
    csv: Annotated[Path | None, typer.Option(help="Errors of all markers: .csv.")] = None,
    picture: Annotated[Path | None, typer.Option(help="The error map: .png.")] = None,
) -> None:
    """Measure the error map of the floor, as the published figure 9 of the swarm's testbed."""
    from tagmetry.arena import audit as audited
    from tagmetry.arena.averaged import averaged
    from tagmetry.cli.arena_options import opened, setup_and_world
    from tagmetry.cli.warmup import tell_compiling
    from tagmetry.detect import Detector
    from tagmetry.files import resolve_family
    from tagmetry.files.atomic import check_destinations

    check_destinations(csv, picture)
    markers = _grid(grid, step, size, height, family, first_id)
    place = _place(at) if at is not None else None
    setup, world = setup_and_world(arena, camera)
    detector = Detector([resolve_family(family)])
    tell_compiling()
    with opened(source, world.view.camera) as taken:
        seen = averaged(
            [detector.detect(one.pixels, world.view.camera) for one in first(taken, images)]
        )
    found = audited(seen, markers, world.view, place)
    _write(found, csv, picture, setup.name)
    typer.echo(_told(found, markers))


def _grid(text: str, step: str, size: str, height: str, family: str, first_id: int) -> "AuditGrid":
    from tagmetry.arena import AuditGrid
    from tagmetry.errors import InputError
    from tagmetry.files.lengths import parse_length_m

    columns, times, rows = text.lower().partition("x")
    if not (times and columns.isdecimal() and rows.isdecimal()):
        raise InputError(f"expected columns and rows of the grid like 24x15, got {text[:40]!r}")
    height_m = 0.0 if height.strip("0.") == "" else parse_length_m(height)
    lengths_m = parse_length_m(step), parse_length_m(size)
    return AuditGrid(int(columns), int(rows), *lengths_m, family, first_id, height_m)


def _place(text: str) -> "GridPlace":
    from math import radians

    from tagmetry.arena import GridPlace
    from tagmetry.errors import InputError

    try:
        x_m, y_m, turn_deg = map(float, text.split(","))
    except ValueError as error:
        raise InputError(
            f"expected the grid's place as x,y,turn in metres and degrees, got {text[:40]!r}"
        ) from error
    return GridPlace(x_m, y_m, radians(turn_deg))


def _write(found: "ErrorMap", csv: Path | None, picture: Path | None, name: str) -> None:
    from tagmetry.errors import InputError
    from tagmetry.files import write_atomically
    from tagmetry.record.error_map import error_map_csv, error_map_picture

    for path, suffix in ((csv, ".csv"), (picture, ".png")):
        if path is not None and path.suffix.lower() != suffix:
            raise InputError(f"expected a file ending in {suffix}, got {path.name[-40:]}")
    if csv is not None:
        write_atomically(csv, error_map_csv(found))
    if picture is not None:
        write_atomically(picture, error_map_picture(found, name))


def _told(found: "ErrorMap", markers: "AuditGrid") -> str:
    """Return the errors in one line for people."""
    near_m = found.below_camera_m(_NEAR_M)
    below = f", {1000 * near_m:.2f} mm below the camera" if near_m >= 0 else ""
    missing = f"; {len(found.missing)} not seen" if found.missing else ""
    return (
        f"{len(found.ids)} of {markers.count} markers: radial error {1000 * found.rms_m:.2f} mm "
        f"rms, {1000 * found.worst_m:.2f} mm at worst{below}{missing}"
    )

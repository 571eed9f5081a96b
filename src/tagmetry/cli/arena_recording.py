"""`tagmetry arena replay` and `tagmetry arena export`: what was recorded, once more."""

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from tagmetry.cli.arena_options import ArenaFile
from tagmetry.cli.options import CameraFile

RecordingFile = Annotated[
    Path, typer.Argument(metavar="RECORDING", help="What `arena run --record` wrote: .mcap.")
]


class Tables(Enum):
    """Formats of tables."""

    csv = "csv"
    parquet = "parquet"


def replay(
    recording: RecordingFile,
    arena: ArenaFile,
    camera: CameraFile = None,
    lines: Annotated[
        bool, typer.Option("--lines", help="Print a line of JSON for each image, as run does.")
    ] = False,
) -> None:
    """Measure a recorded run again, and say whether it gives the same."""
    from tagmetry.cli.arena_options import setup_and_world
    from tagmetry.cli.warmup import tell_compiling
    from tagmetry.pipeline.arena import ArenaMeasurement
    from tagmetry.pipeline.arena.lines import arena_line
    from tagmetry.pipeline.arena.replayed import replay_arena

    setup, world = setup_and_world(arena, camera)
    tell_compiling()
    count, missing_count, largest_px = 0, 0, 0.0
    for replayed in replay_arena(recording, ArenaMeasurement.of(setup, world)):
        count += 1
        missing_count += replayed.missing_count
        largest_px = max(largest_px, replayed.largest_px)
        if lines:
            typer.echo(arena_line(replayed.result))
    typer.echo(_told(count, missing_count, largest_px), err=lines)


def export(
    recording: RecordingFile,
    folder: Annotated[Path, typer.Argument(help="Where the tables go; made where there is none.")],
    tables: Annotated[
        Tables, typer.Option("--format", help="Of the tables: csv or parquet.")
    ] = Tables.csv,
    images: Annotated[bool, typer.Option("--images", help="Write the pictures too.")] = False,
) -> None:
    """Write a recording's markers, states and packets as tables."""
    from tagmetry.record.mcap import export_recording

    written = export_recording(recording, folder, tables.value, images=images)
    for name, count in written.items():
        typer.echo(f"wrote {folder / name}: {count} messages")
    if not written:
        typer.echo(f"tagmetry: {recording} holds nothing to write", err=True)


def _told(count: int, missing_count: int, largest_px: float) -> str:
    """Return the outcome in one line."""
    if count == 0:
        return "the recording holds no image"
    if missing_count == 0 and largest_px == 0:
        return f"{count} images: all markers as recorded"
    return (
        f"{count} images: {missing_count} markers are not in both, "
        f"corners moved by up to {largest_px:.2g} px"
    )

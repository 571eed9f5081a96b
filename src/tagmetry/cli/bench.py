"""`tagmetry bench`: how fast it is, as a ratio to the peers in the same run."""

from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import Json

if TYPE_CHECKING:
    from tagmetry.lab.bench import Timing


def bench(
    *,
    repeats: Annotated[
        int, typer.Option(min=1, help="Runs of each picture; the median counts.")
    ] = 11,
    threads: Annotated[
        int | None, typer.Option(min=1, help="Threads; one, and then all, by default.")
    ] = None,
    json: Json = False,
) -> None:
    """Time detection and pose against OpenCV and the AprilTag library."""
    import os
    from dataclasses import asdict

    import numpy as np

    from tagmetry.lab.bench import bench as timed
    from tagmetry.lab.bench import standard_cases

    cases = standard_cases(np.random.default_rng(0))
    counts = [threads] if threads is not None else sorted({1, os.cpu_count() or 1})
    for count in counts:
        rows = timed(cases, count, repeats)
        if json:
            import json as json_text

            typer.echo("\n".join(json_text.dumps(asdict(row)) for row in rows))
        else:
            typer.echo("\n".join([_heading(count), *map(_line, rows), ""]))


def _heading(threads: int) -> str:
    title = f"{threads} thread{'s' if threads > 1 else ''}"
    return f"{title:<32}{'':<28}{'found':>8} {'median':>10} {'worst':>10} {'ratio':>7}"


def _line(row: "Timing") -> str:
    found = f"{row.found}/{row.expected}"
    times = f"{row.median_ms:7.1f} ms {row.worst_ms:7.1f} ms"
    return f"{row.case:<32}{row.contender:<28}{found:>8} {times} {row.ratio:6.2f}x"

"""`tagmetry arena stability`: how safely a robot follows another at the delay that was measured."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.answer import answer
from tagmetry.cli.options import Json, check_png

if TYPE_CHECKING:
    from tagmetry.arena import NeighbourSensor
    from tagmetry.arena.stability import FollowingSetting

_CURVE_MS = 10.0  # from point to point


def stability(  # noqa: PLR0913 (each argument is an option)
    *,
    arena: Annotated[
        Path | None,
        typer.Argument(metavar="ARENA", help="The arena's file: robots' size, sensor's noise."),
    ] = None,
    delay_ms: Annotated[
        float,
        typer.Option(
            min=0.0, max=2000.0, help="From image to the command's effect, as `arena latency` says."
        ),
    ],
    untold_ms: Annotated[
        float, typer.Option(min=0.0, max=2000.0, help="By what the true delay is longer.")
    ] = 0.0,
    image_rate: Annotated[float, typer.Option(min=1.0, max=250.0, help="Images per second.")] = 30,
    motor_ms: Annotated[float, typer.Option(help="How soon its wheels follow a command.")] = 50.0,
    hold_ms: Annotated[
        float | None, typer.Option(help="Of an integral in their servo, if there is one.")
    ] = None,
    speed: Annotated[float, typer.Option(help="Of the leader, m/s.")] = 0.2,
    length_mm: Annotated[float, typer.Option(help="Of the spring, centre to centre.")] = 200.0,
    stiffness: Annotated[float, typer.Option(help="Of the spring: its rate, 1/s.")] = 10.0,
    damping: Annotated[float, typer.Option(help="Of the spring; 1 is critical.")] = 1.0,
    turning: Annotated[float, typer.Option(help="How soon it faces its leader, 1/s.")] = 5.0,
    diameter_mm: Annotated[
        float | None, typer.Option(help="Of the robots; by default the arena's largest, or 160.")
    ] = None,
    place_sd_mm: Annotated[
        float, typer.Option(min=0.0, max=1e6, help="Noise of a robot's place from image to image.")
    ] = 0.2,
    picture: Annotated[
        Path | None, typer.Option(help="Distances and margins against the delay: .png.")
    ] = None,
    json: Json = False,
) -> None:
    """Say how far a follower is from swinging up, and how much air is left to its leader."""
    from tagmetry.arena import NeighbourSensor
    from tagmetry.arena.controllers import Spring
    from tagmetry.arena.stability import FollowingSetting
    from tagmetry.arena.stability import stability as stability_of
    from tagmetry.cli.arena_stability_report import stability_lines, stability_table

    check_png(picture)
    arenas_m, sensor = _of_arena(arena) if arena is not None else (0.16, NeighbourSensor())
    diameter_m = arenas_m if diameter_mm is None else diameter_mm / 1000
    setting = FollowingSetting(
        Spring(length_mm / 1000, stiffness, damping, turning),
        delay_ms / 1000 + sensor.delay_s,
        untold_ms / 1000,
        1 / image_rate,
        motor_ms / 1000,
        None if hold_ms is None else hold_ms / 1000,
        speed_mps=speed,
    )
    sd_m = ((place_sd_mm / 1000) ** 2 + sensor.range_sd_m**2 / 2) ** 0.5
    report = stability_of(setting, sd_m, diameter_m)
    answer(json=json, table=lambda: stability_table(report), lines=lambda: stability_lines(report))
    if picture is not None:
        _draw(picture, setting, sd_m, diameter_m)


def _of_arena(path: Path) -> "tuple[float, NeighbourSensor]":
    """Return the diameter of the largest robots, and the sensor that all have."""
    from tagmetry.arena import NeighbourSensor
    from tagmetry.files.arena import load_arena

    setup = load_arena(path)
    largest_m = max(one.diameter_m for one in setup.roster.robots)
    return largest_m, setup.sensor or NeighbourSensor()


def _draw(path: Path, setting: "FollowingSetting", sd_m: float, diameter_m: float) -> None:
    import numpy as np

    from tagmetry.arena.stability import stability_by_delay
    from tagmetry.files.atomic import write_atomically
    from tagmetry.record.stability_drawing import stability_picture

    last_ms = max(200.0, 1500 * setting.delay_s)
    delays_s = np.arange(0, last_ms + _CURVE_MS / 2, _CURVE_MS) / 1000
    reports = stability_by_delay(setting, delays_s.tolist(), sd_m, diameter_m)
    write_atomically(path, stability_picture(reports, setting.delay_s))
    typer.echo(f"wrote {path}")

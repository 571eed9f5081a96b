"""`tagmetry arena stability`: how safely a robot follows another at the delay that was measured."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import Json

if TYPE_CHECKING:
    from tagmetry.arena import NeighbourSensor
    from tagmetry.arena.stability import FollowingSetting, Margins, StabilityReport

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
        float, typer.Option(min=0.0, help="Noise of a robot's place from image to image.")
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
    from tagmetry.cli.options import check_png

    if picture is not None:
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
    _tell(report, json=json)
    if picture is not None:
        _draw(picture, setting, sd_m, diameter_m)


def stability_lines(report: "StabilityReport") -> tuple[str, ...]:
    """Return what a report says, line by line."""
    delay_ms = 1000 * report.setting.delay_s
    if not report.is_stable:
        return (f"stability at {delay_ms:.0f} ms: it swings up; take a softer spring",)
    return (
        f"stability at {delay_ms:.0f} ms, along: {_told(report.along)}",
        f"stability at {delay_ms:.0f} ms, facing: {_told(report.across)}",
        f"expected: {1000 * report.nearest_m:.1f} to {1000 * report.farthest_m:.1f} mm apart, "
        f"noise {3000 * report.gap_sd_m:.1f} mm (3 sd), overshoot {100 * report.overshoot:.0f} %; "
        + _air(report),
    )


def _told(one: "Margins") -> str:
    from math import degrees

    return (
        f"gain x {one.gain:.1f}, phase {degrees(one.phase_rad):.0f} deg, "
        f"{1000 * one.delay_s:.0f} ms later than told"
    )


def _air(report: "StabilityReport") -> str:
    if report.air_m < 0:
        return "the bodies may touch"
    return f"{1000 * report.air_m:.1f} mm of air left"


def _tell(report: "StabilityReport", *, json: bool) -> None:
    if not json:
        typer.echo("\n".join(stability_lines(report)))
        return
    import json as json_text

    typer.echo(json_text.dumps(_table(report)))


def _table(report: "StabilityReport") -> dict[str, object]:
    """Return a report as JSON has it: null for what has no end."""
    named = ("overshoot", "nearest_m", "farthest_m", "gap_sd_m", "worst_m", "air_m")
    numbers = {name: _finite(getattr(report, name)) for name in named}
    margins = {
        part: {name: _finite(value) for name, value in vars(getattr(report, part)).items()}
        for part in ("along", "across")
    }
    return {"delay_s": report.setting.delay_s, "is_stable": report.is_stable, **margins, **numbers}


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None


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

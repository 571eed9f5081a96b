"""`tagmetry arena twin`: simulated robots under a simulated camera, through the real pipeline."""

import time
from contextlib import ExitStack, closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import check_png

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tagmetry.arena import WorldState
    from tagmetry.geometry.arrays import AnyPixels
    from tagmetry.pipeline.arena_twin import Moment, PictureEye, Scenario, TwinArena
    from tagmetry.pipeline.arena_twin.summary import Summary
    from tagmetry.record.mcap import Recorder


def twin(  # noqa: PLR0913 (each argument is an option)
    *,
    controller: Annotated[
        str,
        typer.Option(
            help="leader_follower, aggregate, disperse, formation, wander; or a Python file with a "
            "function control(view)."
        ),
    ] = "leader_follower",
    robots: Annotated[int, typer.Option(min=1, max=100, help="How many.")] = 2,
    seconds: Annotated[float, typer.Option(min=0.1, help="Simulated time.")] = 25.0,
    delay: Annotated[
        float, typer.Option(min=0.0, max=1.0, help="From the image to the command's effect, s.")
    ] = 0.05,
    loss: Annotated[float, typer.Option(min=0.0, max=1.0, help="Share of lost packets.")] = 0.0,
    on_board: Annotated[
        bool, typer.Option("--on-board", help="The controller's file steers from the robots.")
    ] = False,
    processes: Annotated[
        bool,
        typer.Option(
            "--processes",
            help="Each robot's computer is a process that speaks the link over UDP; simulated "
            "time waits for all.",
        ),
    ] = False,
    program: Annotated[
        list[str] | None,
        typer.Option(help="A program of your own as a robot's process: 3=./robot; repeatable."),
    ] = None,
    pictures: Annotated[
        bool, typer.Option("--pictures", help="Render every image and find the markers in it.")
    ] = False,
    record: Annotated[Path | None, typer.Option(help="Everything into one file: .mcap.")] = None,
    picture: Annotated[
        Path | None, typer.Option(help="The robots' ways, drawn from above: .png.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of starts and noise.")] = 0,
) -> None:
    """Let simulated robots drive; the arena, the controllers and the packets are the real ones."""
    from tagmetry.cli.arena_twin_robots import manned
    from tagmetry.pipeline.arena_twin import TwinArena
    from tagmetry.pipeline.arena_twin.summary import Summing

    check_png(picture)
    scenario = _scenario(controller, robots, delay, loss, seed)
    file = Path(controller) if on_board else None
    scenario = manned(scenario, file, program or [], processes=processes)
    eye = _picture_eye(scenario) if pictures else None
    summing = Summing()
    worlds: list[WorldState] = []
    started_s = time.monotonic()
    with ExitStack() as stack:
        arena = stack.enter_context(closing(TwinArena(scenario, eye, processes=processes)))
        recorder = _recorder(stack, record)
        for moment in _run(arena, seconds):
            summing.take(moment)
            worlds.append(moment.turn.step.world)
            if recorder is not None:
                _record(recorder, moment, eye.pixels if eye is not None else None)
    tell_summary(summing.summary(), time.monotonic() - started_s)
    if controller == "leader_follower":
        _tell_stability(scenario)
    if picture is not None:
        _draw(picture, scenario, worlds, controller)


def _scenario(controller: str, robots: int, delay_s: float, loss: float, seed: int) -> "Scenario":
    """Return a ready-made scenario, or robots all over the floor with a user's controllers."""
    from tagmetry.pipeline.arena.controller_file import load_controllers
    from tagmetry.pipeline.arena_twin import Radio
    from tagmetry.pipeline.arena_twin.ready import driven_scenario, ready_scenario

    if Path(controller).suffix == ".py":
        scenario = driven_scenario(load_controllers(Path(controller)), robots, seed)
    else:
        scenario = ready_scenario(controller, robots, seed)
    radio = Radio(0.3 * delay_s, 0.0, loss)
    return replace(scenario, camera_delay_s=0.7 * delay_s, radio=radio)


def _picture_eye(scenario: "Scenario") -> "PictureEye":
    import numpy as np

    from tagmetry.pipeline.arena_twin import PictureEye
    from tagmetry.pipeline.arena_twin.ready.stage import floor, shot

    robots = [one.robot for one in scenario.robots]
    return PictureEye(robots, floor(scenario.seed), shot(), np.random.default_rng(scenario.seed))


def _run(arena: "TwinArena", seconds: float) -> "Iterator[Moment]":
    """Return all moments, under a progress bar where a person watches."""
    from tagmetry.cli.interrupts import whole
    from tagmetry.cli.progress import counted

    count = round(seconds * arena.scenario.image_rate_hz)
    return whole(counted(arena.run(seconds), count, "simulating"))


def _recorder(stack: ExitStack, path: Path | None) -> "Recorder | None":
    if path is None:
        return None
    from tagmetry.record.mcap import Recorder

    return stack.enter_context(Recorder(path))


def _record(recorder: "Recorder", moment: "Moment", pixels: "AnyPixels | None") -> None:
    from tagmetry.camera import Image

    if pixels is not None:
        recorder.image(Image(pixels, moment.image_s, "capture", source="twin"))
    recorder.state(moment.turn.step.world)


def tell_summary(summary: "Summary", took_s: float) -> None:
    """Print what a run came to."""
    apart = "" if summary.nearest_m == float("inf") else f"; nearest {summary.nearest_m:.3f} m"
    typer.echo(
        f"{summary.duration_s:.1f} s in {took_s:.1f} s: {summary.images} images, "
        f"{summary.driven_m:.2f} m driven, places within {1000 * summary.place_rms_m:.2f} mm "
        f"(rms){apart}"
    )
    for one, other in sorted(summary.touched):
        typer.echo(f"robots {one} and {other} touched")
    for told in summary.stopped:
        typer.echo(f"stopped: {told}")


def _tell_stability(scenario: "Scenario") -> None:
    """Print what was to be expected of followers at this delay."""
    from tagmetry.arena.stability import FollowingSetting, stability
    from tagmetry.cli.arena_stability_report import stability_lines
    from tagmetry.pipeline.arena_twin.run import TICK_S

    twin = scenario.robots[0]
    setting = FollowingSetting(
        delay_s=scenario.delay_s,
        untold_s=TICK_S,  # until the robot's computer looks at what has arrived
        image_s=1 / scenario.image_rate_hz,
        motor_s=twin.design.servo_time_s,
        hold_s=twin.design.servo_hold_s,
    )
    report = stability(setting, diameter_m=twin.robot.diameter_m)
    typer.echo("\n".join(stability_lines(report)))


def _draw(path: Path, scenario: "Scenario", worlds: "list[WorldState]", title: str) -> None:
    from tagmetry.files.atomic import write_atomically
    from tagmetry.record.arena_drawing import ways_picture

    radii_m = {one.robot.id: one.robot.radius_m for one in scenario.robots}
    write_atomically(path, ways_picture(worlds, radii_m, title))
    typer.echo(f"wrote {path}")

"""`tagmetry arena run`: where every robot is, image by image, and what each may know."""

from collections.abc import Callable, Generator
from contextlib import ExitStack, closing
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.arena_options import ArenaFile, SourceName
from tagmetry.cli.options import CameraFile, first

if TYPE_CHECKING:
    from tagmetry.arena.controllers import Controller
    from tagmetry.files.arena import ArenaSetup, ArenaWorld
    from tagmetry.link import Host
    from tagmetry.pipeline.arena import ArenaResult, Beside, Latency, Taker
    from tagmetry.record.mcap import Recorder


def run(  # noqa: PLR0913 (each argument is an option)
    *,
    source: SourceName,
    arena: ArenaFile,
    camera: CameraFile = None,
    out: Annotated[
        Path | None, typer.Option(help="States of all robots: .jsonl; instead of here.")
    ] = None,
    link: Annotated[
        str | None,
        typer.Option(help="Talk to the robots from this address: 127.0.0.1, 192.168.1.5:6160."),
    ] = None,
    record: Annotated[
        Path | None,
        typer.Option(help="Record images, markers, states and all packets: .mcap."),
    ] = None,
    lossless: Annotated[
        bool, typer.Option("--lossless", help="Record images as PNG: they replay bit by bit.")
    ] = False,
    poses: Annotated[
        bool, typer.Option(help="Robots may know where they are, not only their neighbours.")
    ] = False,
    controller: Annotated[
        Path | None,
        typer.Option(help="Python file with a function control(view) that drives every robot."),
    ] = None,
    virtual: Annotated[
        int, typer.Option(min=0, max=100, help="So many simulated robots more.")
    ] = 0,
    lead: Annotated[
        float, typer.Option(min=0.0, max=0.5, help="Predict so many seconds further ahead.")
    ] = 0.0,
    quiet: Annotated[bool, typer.Option("--quiet", help="Print no line for each image.")] = False,
    limit: Annotated[int | None, typer.Option(min=1, help="Stop after so many images.")] = None,
) -> None:
    """Follow the robots of an arena; print a line of JSON for each image."""
    from tagmetry.cli.arena_computers import bridge_takers, opened_bridge, shared_controllers
    from tagmetry.cli.arena_options import opened, setup_and_world
    from tagmetry.cli.warmup import tell_compiling
    from tagmetry.pipeline.arena import ArenaMeasurement, Latency, run_arena

    setup, world = setup_and_world(arena, camera)
    setup = _with_virtual(setup, world, virtual)
    controllers = _controllers(controller, link, has_virtual=bool(setup.virtual))
    tell_compiling()
    latency = Latency()
    with ExitStack() as stack:
        images = stack.enter_context(opened(source, world.view.camera))
        hears = link is not None or bool(setup.virtual)
        bridge = opened_bridge(stack, setup, has_listeners=hears)
        controllers, is_driven = shared_controllers(bridge, controllers)
        task = ArenaMeasurement.of(
            setup,
            world,
            is_live=images.is_live,
            lead_s=lead,
            controllers=controllers,
            is_driven=is_driven,
            beside=_beside(setup, world),
        )
        stack.callback(task.turning.drivers.close)
        recorder = _recorder(stack, record, lossless=lossless, live=images.is_live)
        takers = _talkers(stack, setup, link, recorder, poses=poses)
        takers += bridge_takers(bridge, setup, task)
        takers += _writers(stack, out, recorder, quiet=quiet, live=images.is_live)
        results = closing(run_arena(first(images, limit), task, takers, latency))
        _follow(stack.enter_context(results))
    _sum_up(latency)


def _follow(results: "Generator[ArenaResult]") -> None:
    """Take all results, and say once what a person must know."""
    from tagmetry.cli.interrupts import whole

    told: set[str] = set()
    for result in whole(results):
        _warn(result, told)


def _with_virtual(setup: "ArenaSetup", world: "ArenaWorld", count: int) -> "ArenaSetup":
    """Return an arena with more simulated robots, in the middle of what the camera sees."""
    import numpy as np

    from tagmetry.files.arena import with_virtual

    if not count:
        return setup
    middle_px = (np.array(world.view.camera.size_px) - 1) / 2
    x_m, y_m, _ = world.view.points_on_plane(middle_px).tolist()
    return with_virtual(setup, count, (x_m, y_m))


def _beside(setup: "ArenaSetup", world: "ArenaWorld") -> "Beside | None":
    """Return the arena's simulated robots, where it has any."""
    if not setup.virtual:
        return None
    import numpy as np

    from tagmetry.pipeline.arena_twin.virtual import VirtualRobots

    rng = np.random.default_rng(setup.seed)
    return VirtualRobots(setup.roster, setup.virtual, world.view, rng)


def _controllers(
    path: Path | None, link: str | None, *, has_virtual: bool
) -> "Callable[[int], Controller] | None":
    """Return what makes every robot's controller; real ones need a link to hear its commands."""
    if path is None:
        return None
    from tagmetry.errors import InputError
    from tagmetry.pipeline.arena.controller_file import load_controllers

    if link is None and not has_virtual:
        raise InputError("--controller drives robots, and they hear nothing without --link ADDRESS")
    return load_controllers(path)


def _recorder(
    stack: ExitStack, path: Path | None, *, lossless: bool, live: bool
) -> "Recorder | None":
    """Return a recorder that is open, where one is wanted; of files it drops nothing."""
    if path is None:
        return None
    from tagmetry.record.mcap import Recorder

    quality = None if lossless else 90
    return stack.enter_context(Recorder(path, jpeg_quality=quality, may_drop=live))


def _talkers(
    stack: ExitStack,
    setup: "ArenaSetup",
    link: str | None,
    recorder: "Recorder | None",
    *,
    poses: bool,
) -> "list[Taker]":
    """Return who talks to the robots, if anybody shall."""
    if link is None:
        return []
    from tagmetry.pipeline.arena.linked import LinkTaker, sensor_ranges_m

    host = open_host(stack, setup, link, recorder)
    ranges_m = sensor_ranges_m(setup)
    return [LinkTaker(host, *ranges_m, poses=poses, silent=setup.virtual.keys())]


def open_host(
    stack: ExitStack, setup: "ArenaSetup", link: str, recorder: "Recorder | None" = None
) -> "Host":
    """Return the link's host at an address like 192.168.1.5:47474, which is recorded if wanted."""
    from tagmetry.errors import InputError
    from tagmetry.link import PORT, Host, Packet
    from tagmetry.pipeline.arena.recorded import record_packet

    def note(packet: Packet) -> None:
        if recorder is not None:
            record_packet(recorder, packet)

    address, _, port = link.partition(":")
    if port and not (port.isdecimal() and int(port) <= 0xFFFF):
        raise InputError(f"expected an address like 192.168.1.5:{PORT}, got {link[:40]!r}")
    at_port = int(port) if port else PORT
    return stack.enter_context(Host(setup.keys(), address, at_port, on_packet=note))


def _writers(
    stack: ExitStack,
    out: Path | None,
    recorder: "Recorder | None",
    *,
    quiet: bool,
    live: bool,
) -> "list[Taker]":
    """Return who writes the results: the recorder, which has a queue, and lines behind one."""
    from tagmetry.pipeline.arena import Posted
    from tagmetry.pipeline.arena.lines import LineTaker
    from tagmetry.pipeline.arena.recorded import RecorderTaker

    takers: list[Taker] = [RecorderTaker(recorder)] if recorder is not None else []
    if out is not None:
        takers.append(Posted(LineTaker(_line_writer(stack, out)), longest=1000, may_drop=live))
    elif not quiet:
        takers.append(Posted(LineTaker(typer.echo), longest=4, may_drop=live))
    return takers


def _line_writer(stack: ExitStack, path: Path) -> "Callable[[str], object]":
    """Return what writes a line to a file at once, so that others can read along."""
    from tagmetry.errors import InputError
    from tagmetry.files.atomic import refusing

    if path.suffix.lower() != ".jsonl":
        raise InputError(f"the states are JSON lines; name the file like states.jsonl, got {path}")
    with refusing(path):
        file = stack.enter_context(path.open("wb", buffering=0))
    return lambda line: file.write(line.encode() + b"\n")


def _warn(result: "ArenaResult", told: set[str]) -> None:
    """Say once on standard error what a person must know."""
    step = result.step
    remarks = [one.told for one in step.events if one.kind in ("jumped", "swapped", "lost")]
    if step.is_bumped and step.bump is not None and "bump" not in told:
        told.add("bump")
        remarks.append(f"all robots are stopped: {step.bump.told}")
    if step.bump is not None and step.bump.seen == 0 and "floor" not in told:
        told.add("floor")
        remarks.append(step.bump.told)
    for key in step.strangers:
        if str(key) not in told:
            told.add(str(key))
            remarks.append(f"{key.family} id {key.id} is no robot's and no floor marker")
    for remark in remarks:
        typer.echo(f"tagmetry: {result.world.time_s:.2f} s: {remark}", err=True)


def _sum_up(latency: "Latency") -> None:
    if len(latency):
        typer.echo(f"tagmetry: {len(latency)} images; image to result {latency.told}", err=True)

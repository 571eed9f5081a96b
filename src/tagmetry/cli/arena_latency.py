"""`tagmetry arena latency`: how long from a command until the camera sees the robot obey."""

from contextlib import ExitStack, closing
from typing import Annotated

import typer

from tagmetry.cli.arena_options import ArenaFile, SourceName
from tagmetry.cli.options import CameraFile


def latency(
    *,
    source: SourceName,
    arena: ArenaFile,
    robot: Annotated[int, typer.Option(help="Which robot turns to and fro; it needs room.")],
    link: Annotated[str, typer.Option(help="Talk to the robots from this address.")] = "127.0.0.1",
    camera: CameraFile = None,
    turn_rate: Annotated[
        float, typer.Option(min=0.1, max=10.0, help="How fast it turns, in rad/s.")
    ] = 1.5,
) -> None:
    """Let a robot turn to and fro, and measure the delay from command to image."""
    import numpy as np

    from tagmetry.arena import wiggle
    from tagmetry.cli.arena_options import opened, setup_and_world
    from tagmetry.cli.arena_run import open_host
    from tagmetry.errors import InputError
    from tagmetry.pipeline.arena import ArenaMeasurement, run_arena
    from tagmetry.pipeline.arena.wiggled import WiggleTaker

    setup, world = setup_and_world(arena, camera)
    rows = [one.id for one in setup.roster.robots]
    if robot not in rows:
        raise InputError(f"there is no robot {robot} in {arena}: only {rows}")
    schedule = wiggle(np.random.default_rng(), turn_rate)
    with ExitStack() as stack:
        images = stack.enter_context(opened(source, world.view.camera))
        if not images.is_live:
            raise InputError(f"{images.name} is no live camera: nothing in it can obey")
        host = open_host(stack, setup, link)
        task = ArenaMeasurement.of(setup, world, is_live=True)
        taker = WiggleTaker(host, robot, rows.index(robot), schedule)
        for _ in stack.enter_context(closing(run_arena(images, task, [taker]))):
            if taker.is_done:
                break
    found = taker.reaction()
    if found.why_not:
        raise InputError(f"robot {robot}: no delay can be told: {found.why_not}")
    typer.echo(
        f"robot {robot}: {1000 * found.delay_s:.1f} ms (± {1000 * found.sd_s:.1f}) from command to "
        f"image, turned {found.gain:.2f} of what it was told; "
        f"tagmetry arena run --lead {found.delay_s:.3f}"
    )

"""`tagmetry arena mount`: how a marker lies on a robot, by letting the robot turn and drive."""

from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.arena_options import ArenaFile, SourceName
from tagmetry.cli.options import CameraFile

if TYPE_CHECKING:
    from tagmetry.arena import Robot
    from tagmetry.detect import Detection
    from tagmetry.files.arena import ArenaWorld
    from tagmetry.geometry import Array


def mount(
    *,
    source: SourceName,
    arena: ArenaFile,
    robot: Annotated[int, typer.Option(help="Id of the robot.")],
    drive: Annotated[
        str | None, typer.Option(help="Source of a straight drive ahead, for the marker's turn.")
    ] = None,
    size_sd: Annotated[
        float,
        typer.Option(min=0.0, max=1.0, help="Deviation of the marker's size, as a share of it."),
    ] = 0.002,
    camera: CameraFile = None,
) -> None:
    """Measure how a robot's marker is mounted, from images of it turning on the spot."""
    from tagmetry.cli.arena_options import setup_and_world
    from tagmetry.errors import InputError

    setup, world = setup_and_world(arena, camera)
    by_id = {one.id: one for one in setup.roster.robots}
    if robot not in by_id:
        listed = ", ".join(map(str, by_id))
        raise InputError(f"there is no robot {robot} in {arena}; there are {listed}")
    turning = _seen(source, by_id[robot], world)
    driving = _seen(drive, by_id[robot], world) if drive is not None else []
    typer.echo(_measured(turning, driving, by_id[robot], world, size_sd))


def _seen(source: str, robot: "Robot", world: "ArenaWorld") -> "list[Detection]":
    """Return the robot's marker in every image that shows it once."""
    from tagmetry.cli.arena_options import opened
    from tagmetry.detect import Detector
    from tagmetry.files import resolve_family

    camera = world.view.camera
    detector = Detector([resolve_family(robot.family)])
    found = []
    with opened(source, camera) as images:
        for image in images:
            own = [d for d in detector.detect(image.pixels, camera) if d.id == robot.marker_id]
            found += own if len(own) == 1 else []
    return found


def _measured(
    turning: "list[Detection]",
    driving: "list[Detection]",
    robot: "Robot",
    world: "ArenaWorld",
    size_sd: float,
) -> str:
    """Return the lines for the arena's file, with what they rest on as comments."""
    import numpy as np

    from tagmetry.arena import height_by_size, offset_from_spin, turn_from_drive

    size_m = robot.marker_size_m
    high = height_by_size(
        world.view, turning + driving, size_m, size_sd * size_m, robot.mount.height_m
    )
    spin = offset_from_spin(_places(turning, robot, world))
    turn, known = robot.mount.turn_rad, "as it was"
    if driving:
        found = turn_from_drive(_places(driving, robot, world), spin)
        turn, known = found.value, f"± {np.degrees(found.sd):.2f}"
    forward_m, left_m = spin.forward_left_m(turn)
    sd_mm = 1000 * np.sqrt(np.trace(spin.covariance))
    told = f"{high.value:.4f} ± {high.sd:.4f} m over the floor"
    return "\n".join(
        [
            f"# {len(turning)} images of a turn: {1000 * spin.rms_m:.2f} mm from a circle",
            f"forward_m: {forward_m:.4f}  # ± {sd_mm:.2f} mm",
            f"left_m: {left_m:.4f}",
            f"turn_deg: {np.degrees(turn):.2f}  # {known}",
            f"# by its size the marker is {told}; the file says {robot.mount.height_m:.4f}",
        ]
    )


def _places(seen: "list[Detection]", robot: "Robot", world: "ArenaWorld") -> "Array":
    """Return the marker's places at the height of the file, shape (n, 3)."""
    import numpy as np

    from tagmetry.arena import fit_squares

    return fit_squares(
        world.view,
        np.array([one.corners_px for one in seen]).reshape(-1, 4, 2),
        np.array([one.corners_cov_px2 for one in seen]).reshape(-1, 8, 8),
        np.full(len(seen), robot.marker_size_m),
        np.full(len(seen), robot.mount.height_m),
    ).places

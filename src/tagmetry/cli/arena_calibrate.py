"""`tagmetry arena calibrate`: where the camera hangs, and where the floor markers lie."""

from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.arena_options import ArenaFile, SourceName
from tagmetry.cli.options import CameraFile

if TYPE_CHECKING:
    from tagmetry.files.arena import ArenaWorld


def calibrate(
    *,
    source: SourceName,
    arena: ArenaFile,
    camera: CameraFile = None,
    images: Annotated[int, typer.Option(min=1, help="At most so many images are averaged.")] = 30,
) -> None:
    """Measure the arena's world from its floor markers, and write it beside the arena's file."""
    from tagmetry.cli.arena_options import opened, setup_and_camera
    from tagmetry.cli.warmup import tell_compiling
    from tagmetry.files.arena import save_world
    from tagmetry.pipeline.arena import calibrate_arena

    setup, found = setup_and_camera(arena, camera)
    tell_compiling()
    with opened(source, found) as taken:
        world = calibrate_arena(taken, setup, found, images)
    save_world(world, setup.world_file)
    for line in _told(world):
        typer.echo(line)
    typer.echo(f"wrote {setup.world_file}")


def _told(world: "ArenaWorld") -> list[str]:
    """Return the camera's place and the floor markers' for people."""
    import numpy as np

    from tagmetry.cli.deviations import decimals_of

    x_m, y_m, z_m = world.view.T_world_camera.translation
    deviation_mm = 1000 * np.sqrt(np.diag(world.view.covariance)[:3])
    lean_deg = np.degrees(np.arccos(-world.view.T_world_camera.rotation.as_matrix()[2, 2]))
    sd = " ".join(f"{value:.{decimals_of(value)}f}" for value in deviation_mm)
    place = f"camera at x {x_m:z.4f} y {y_m:z.4f} z {z_m:z.4f} m (± {sd} mm)"
    lines = [f"{place}, {lean_deg:.1f} degrees from straight down"]
    for one in world.floor.markers:
        x_m, y_m, _ = one.T_world_marker.translation
        turn_deg = np.degrees(one.T_world_marker.rotation.as_euler("zyx")[0])
        sd_mm = 1000 * np.sqrt(np.trace(one.covariance[:2, :2]))
        known = f"± {sd_mm:.{decimals_of(sd_mm)}f} mm" if sd_mm > 0 else "as given"
        at = f"x {x_m:z.5f} y {y_m:z.5f} m"
        lines.append(f"floor marker {one.id}: {at}, {turn_deg:z.2f}°, {known}")
    return lines

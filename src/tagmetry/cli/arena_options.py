"""What the subcommands of `tagmetry arena` share: the arena's file, its camera and its world."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.camera import Camera, Source
    from tagmetry.files.arena import ArenaSetup, ArenaWorld

SourceName = Annotated[
    str,
    typer.Argument(
        metavar="SOURCE",
        help="Picture, folder, glob, video, camera number, /dev/video0, rtsp://, http://, or a "
        "simulated camera.",
    ),
]
ArenaFile = Annotated[
    Path, typer.Argument(metavar="ARENA", help="The arena's file: robots, floor markers, fence.")
]


def setup_and_camera(path: Path, camera: Path | None) -> "tuple[ArenaSetup, Camera]":
    """Return an arena and the intrinsics of its images: the option's, else the arena's own."""
    from tagmetry.errors import InputError
    from tagmetry.files import load_camera
    from tagmetry.files.arena import load_arena

    setup = load_arena(path)
    camera_file = camera if camera is not None else setup.camera_file
    if camera_file is None:
        raise InputError(
            f"{path}: the camera's intrinsics are needed: name their file under camera, or give "
            "--camera"
        )
    return setup, load_camera(camera_file)


def setup_and_world(path: Path, camera: Path | None) -> "tuple[ArenaSetup, ArenaWorld]":
    """Return an arena and its world, as it was calibrated."""
    from tagmetry.files.arena import load_world

    setup, found = setup_and_camera(path, camera)
    return setup, load_world(setup.world_file, found)


def opened(source: str, camera: "Camera") -> "Source":
    """Return the images, which must be of the camera's size; says when a live one is lost."""
    from tagmetry.cli.live_state import StateTeller
    from tagmetry.pipeline import open_images

    return open_images(source, camera=camera, on_state=StateTeller(source))

"""`tagmetry camera`: look at a camera file, and convert it."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import Json

if TYPE_CHECKING:
    from tagmetry.camera import Camera

app = typer.Typer(help="Look at camera files and convert them.", no_args_is_help=True)

File = Annotated[Path, typer.Argument(metavar="CAMERA", help="ROS, OpenCV or Kalibr file.")]
Name = Annotated[str | None, typer.Option(help="Which camera of a file with several.")]


@app.command()
def show(file: File, *, name: Name = None, json: Json = False) -> None:
    """Say what a camera file holds, and what is odd about it."""
    from tagmetry.cli.camera_report import camera_lines, camera_table
    from tagmetry.files import load_camera

    camera = load_camera(file, name)
    if json:
        import json as json_text

        typer.echo(json_text.dumps(camera_table(camera)))
    else:
        typer.echo("\n".join(camera_lines(camera)))


@app.command()
def convert(
    file: File,
    out: Annotated[Path, typer.Argument(metavar="OUT", help="File to write.")],
    *,
    file_format: Annotated[
        str, typer.Option("--format", help="ros, opencv (YAML, or JSON by suffix) or kalibr.")
    ] = "ros",
    name: Name = None,
    crop: Annotated[
        str | None, typer.Option(help="Cut out a window first: 640x480+100+50.")
    ] = None,
    scale_to: Annotated[
        str | None, typer.Option(help="Then resample the images to a size: 640x480.")
    ] = None,
    zoom: Annotated[float | None, typer.Option(help="Then zoom digitally, 1 or more.")] = None,
    rotate: Annotated[
        int, typer.Option(help="Then turn the images clockwise, a multiple of 90 degrees.")
    ] = 0,
) -> None:
    """Write a camera file in another format, or for images that were changed."""
    from tagmetry.camera import zoomed
    from tagmetry.errors import InputError
    from tagmetry.files import load_camera, save_camera

    if file_format not in ("ros", "opencv", "kalibr"):
        raise InputError(f"unknown format {file_format!r}; there are ros, opencv and kalibr")
    camera = _cropped(load_camera(file, name), crop)
    camera = _scaled(camera, scale_to)
    camera = zoomed(camera, zoom) if zoom is not None else camera
    camera = _rotated(camera, rotate)
    save_camera(camera, out, file_format)  # type: ignore[arg-type]
    typer.echo(f"wrote {camera.width_px}x{camera.height_px} camera -> {out}")


def _cropped(camera: "Camera", window: str | None) -> "Camera":
    from tagmetry.camera import cropped

    if window is None:
        return camera
    width_px, height_px, left_px, top_px = _numbers(
        window, "640x480+100+50", r"(\d+)x(\d+)\+(\d+)\+(\d+)"
    )
    return cropped(camera, left_px, top_px, width_px, height_px)


def _scaled(camera: "Camera", size: str | None) -> "Camera":
    from tagmetry.camera import scaled

    if size is None:
        return camera
    width_px, height_px = _numbers(size, "640x480", r"(\d+)x(\d+)")
    return scaled(camera, width_px, height_px)


def _rotated(camera: "Camera", angle_deg: int) -> "Camera":
    from tagmetry.camera import rotated
    from tagmetry.errors import InputError

    if angle_deg % 90:
        raise InputError(f"images are turned by multiples of 90 degrees, got {angle_deg}")
    return rotated(camera, angle_deg // 90)


def _numbers(text: str, example: str, pattern: str) -> tuple[int, ...]:
    import re

    from tagmetry.errors import InputError

    match = re.fullmatch(pattern, text, re.ASCII)
    if match is None or max(map(len, match.groups())) > 6:
        raise InputError(f"expected pixels like {example}, found {text[:40]!r}")
    return tuple(int(number) for number in match.groups())

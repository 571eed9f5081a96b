"""`tagmetry camera`: look at a camera file or a bank of them, convert it, keep the bank."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.answer import answer
from tagmetry.cli.options import Json
from tagmetry.cli.pixels import whole_numbers

if TYPE_CHECKING:
    from tagmetry.camera import Camera

app = typer.Typer(
    help="Look at camera files, convert them, keep a bank of them.", no_args_is_help=True
)

File = Annotated[
    Path,
    typer.Argument(metavar="CAMERA", help="ROS, OpenCV, Kalibr, mrcal, PhotonVision or COLMAP."),
]
Name = Annotated[str | None, typer.Option(help="Which camera of a file with several.")]


@app.command()
def show(
    file: Annotated[Path, typer.Argument(metavar="CAMERA", help="Camera file, or a bank.")],
    *,
    name: Name = None,
    json: Json = False,
    step: Annotated[
        float | None, typer.Option(help="Of a bank: step of the focus; larger ones are gaps.")
    ] = None,
) -> None:
    """Say what a camera file or a bank of calibrations holds, and what is odd about it."""
    from tagmetry.cli import bank_report, camera_report
    from tagmetry.files import load_bank, load_camera
    from tagmetry.files.bank import is_bank_file

    if is_bank_file(file):
        bank = load_bank(file)
        answer(
            json=json,
            table=lambda: bank_report.bank_table(bank, step),
            lines=lambda: bank_report.bank_lines(bank, step),
        )
    else:
        camera = load_camera(file, name)
        answer(
            json=json,
            table=lambda: camera_report.camera_table(camera),
            lines=lambda: camera_report.camera_lines(camera),
        )


@app.command()
def bank(
    file: Annotated[Path, typer.Argument(metavar="BANK", help="Bank; made where there is none.")],
    *,
    add: Annotated[
        list[Path] | None,
        typer.Option(help="Calibration with its focus to put in; may be given several times."),
    ] = None,
    approach: Annotated[
        str | None, typer.Option(help="How those were focused: 'from near' or 'from far'.")
    ] = None,
    drop: Annotated[
        str | None, typer.Option(help="Take out what stands at a setting: focus=35,zoom=200.")
    ] = None,
    zoom_is_digital: Annotated[
        bool | None,
        typer.Option("--digital-zoom/--optical-zoom", help="Zoom only enlarges the middle."),
    ] = None,
    may_scale: Annotated[
        bool | None,
        typer.Option("--may-scale/--no-scale", help="Other image sizes are the same, resampled."),
    ] = None,
    at: Annotated[
        str | None,
        typer.Option(help="Give the camera at a setting: focus=35,zoom=200,size=1920x1080."),
    ] = None,
    out: Annotated[Path | None, typer.Option(help="File to write that camera to.")] = None,
) -> None:
    """Put calibrations into a bank, and get the camera at a focus and zoom between them."""
    from tagmetry.cli.bank_edit import camera_at, edited
    from tagmetry.cli.camera_report import camera_lines
    from tagmetry.files import save_bank, save_camera

    changes = (add, drop, zoom_is_digital, may_scale)
    calibrations = edited(file, add or [], approach, drop, zoom_is_digital, may_scale)
    camera = camera_at(calibrations, at, out)
    if any(change is not None for change in changes):
        save_bank(calibrations, file)
        typer.echo(f"wrote bank of {len(calibrations.nodes)} -> {file}")
    if camera is not None and out is not None:
        save_camera(camera, out)
        typer.echo(f"wrote {camera.width_px}x{camera.height_px} camera -> {out}")
    elif camera is not None:
        typer.echo("\n".join(camera_lines(camera)))


@app.command()
def convert(
    file: File,
    out: Annotated[Path, typer.Argument(metavar="OUT", help="File to write.")],
    *,
    file_format: Annotated[
        str,
        typer.Option(
            "--format",
            help="ros, opencv (YAML, or JSON by suffix), kalibr, mrcal, photonvision or colmap.",
        ),
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
    from typing import get_args

    from tagmetry.camera import zoomed
    from tagmetry.errors import InputError
    from tagmetry.files import CameraFormat, load_camera, save_camera

    if file_format not in get_args(CameraFormat):
        known = ", ".join(get_args(CameraFormat))
        raise InputError(f"unknown format {file_format!r}; there are {known}")
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
    width_px, height_px, left_px, top_px = whole_numbers(
        window, "640x480+100+50", r"(\d+)x(\d+)\+(\d+)\+(\d+)"
    )
    return cropped(camera, left_px, top_px, width_px, height_px)


def _scaled(camera: "Camera", size: str | None) -> "Camera":
    from tagmetry.camera import scaled

    if size is None:
        return camera
    width_px, height_px = whole_numbers(size, "640x480", r"(\d+)x(\d+)")
    return scaled(camera, width_px, height_px)


def _rotated(camera: "Camera", angle_deg: int) -> "Camera":
    from tagmetry.camera import rotated
    from tagmetry.errors import InputError

    if angle_deg % 90:
        raise InputError(f"images are turned by multiples of 90 degrees, got {angle_deg}")
    return rotated(camera, angle_deg // 90)

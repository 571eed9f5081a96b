"""`tagmetry plan`: how exact a pose will be, before a marker is printed."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.answer import answer
from tagmetry.cli.options import Json, check_png

if TYPE_CHECKING:
    from tagmetry.pose.plan import Free, Setup

_ANYTHING = 1.0  # stands for what is solved for


def plan(  # noqa: PLR0913 (each argument is an option)
    *,
    camera: Annotated[
        Path, typer.Option(help="Camera file; its covariance says what the calibration is worth.")
    ],
    size: Annotated[
        str | None, typer.Option(help="Side of the black square: 0.12, 120mm, 12cm.")
    ] = None,
    distance: Annotated[
        str | None, typer.Option(help="From the camera to the marker: 2.5, 80cm.")
    ] = None,
    want: Annotated[
        str | None,
        typer.Option(
            help="Allowed error of the position, like 2mm: solves for the size or the distance, "
            "whichever is left out, or for the resolution."
        ),
    ] = None,
    tilt: Annotated[
        float, typer.Option(help="Degrees between the marker's normal and the line of sight.")
    ] = 30.0,
    at: Annotated[
        str | None, typer.Option(help="Pixel of its centre, like 320,100; by default the middle.")
    ] = None,
    family: Annotated[str, typer.Option(help="Family of the marker.")] = "tag36h11",
    size_error: Annotated[
        str, typer.Option(help="Standard deviation of the side as it was measured on paper.")
    ] = "0.05mm",
    noise: Annotated[float, typer.Option(help="Of a pixel, grey values of 255.")] = 2.0,
    contrast: Annotated[float, typer.Option(help="Paper less ink, grey values.")] = 150.0,
    blur: Annotated[float, typer.Option(help="Standard deviation of the lens's blur, px.")] = 0.6,
    speed: Annotated[float, typer.Option(help="Of the marker, along rows, m/s.")] = 0.0,
    exposure: Annotated[float, typer.Option(help="Seconds.")] = 0.01,
    picture: Annotated[
        Path | None, typer.Option(help="Accuracy over the working volume, from above: .png.")
    ] = None,
    json: Json = False,
) -> None:
    """Say how exact a marker's pose will be, what limits it, and how far it is found."""
    from tagmetry.cli.plan_report import plan_lines, plan_table
    from tagmetry.files import load_camera, resolve_family
    from tagmetry.files.lengths import parse_length_m
    from tagmetry.pose.plan import Imaging, Setup, predict, solved

    check_png(picture)
    free = _free(size, distance, want)
    setup = Setup(
        load_camera(camera),
        parse_length_m(size) if size is not None else _ANYTHING,
        parse_length_m(distance) if distance is not None else _ANYTHING,
        tilt,
        pixel=_pixel(at),
        family=resolve_family(family),
        speed_m_s=speed,
        size_sd_m=parse_length_m(size_error),
        imaging=Imaging.of_contrast(contrast, noise, blur, exposure),
    )
    if want is not None and free is not None:
        setup = solved(setup, parse_length_m(want), free)
    prediction = predict(setup)
    answer(
        json=json,
        table=lambda: plan_table(prediction, free),
        lines=lambda: plan_lines(prediction, free),
    )
    if picture is not None:
        _draw(setup, picture)


def _pixel(text: str | None) -> tuple[float, float] | None:
    from tagmetry.cli.pixels import whole_numbers

    if text is None:
        return None
    u, v = whole_numbers(text, "320,100", r"(\d+),(\d+)")
    return float(u), float(v)


def _free(size: str | None, distance: str | None, want: str | None) -> "Free | None":
    """Return what is to be solved for, None for nothing."""
    from tagmetry.errors import InputError

    if want is None and (size is None or distance is None):
        raise InputError("expected --size and --distance, or --want with at least one of them")
    if size is None and distance is None:
        raise InputError("--want solves for one thing: give --size, --distance, or both of them")
    if want is None:
        return None
    return "size" if size is None else "distance" if distance is None else "resolution"


def _draw(setup: "Setup", path: Path) -> None:
    from tagmetry.files.atomic import write_atomically
    from tagmetry.pose.plan import over_volume
    from tagmetry.record.plan_picture import plan_picture

    write_atomically(path, plan_picture(setup, over_volume(setup)))

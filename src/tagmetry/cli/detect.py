"""`tagmetry detect`: markers and their poses from pictures, videos and cameras."""

from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import CameraFile, Families, Inverted, Json, Size, measurement

if TYPE_CHECKING:
    from tagmetry.camera import Image, Source
    from tagmetry.detect import Rejection
    from tagmetry.pipeline import Measurement
    from tagmetry.record import ImageResult, Writer


def detect(  # noqa: PLR0913 (each argument is an option)
    *,
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="SOURCE...",
            help="Picture, folder, glob, video, camera number, /dev/video0, rtsp:// or http://.",
        ),
    ],
    family: Families = ["tag36h11"],  # noqa: B006 (Typer copies it)
    size: Size = None,
    camera: CameraFile = None,
    out: Annotated[
        str | None,
        typer.Option(help="Results: .jsonl, .csv, .parquet or .tum; - for JSON lines here."),
    ] = None,
    overlay: Annotated[
        Path | None,
        typer.Option(help="Pictures or a video with what was found: .png, .jpg or .mp4."),
    ] = None,
    json: Json = False,
    explain: Annotated[
        bool, typer.Option("--explain", help="Say why squares were turned down.")
    ] = False,
    cube: Annotated[bool, typer.Option("--cube", help="Draw a cube on every marker.")] = False,
    inverted: Inverted = False,
    forgive_bits: Annotated[
        int | None, typer.Option(help="Wrong bits to forgive; by default as the family allows.")
    ] = None,
    min_side: Annotated[
        float | None, typer.Option(help="Smallest side of a marker to look for, in pixels.")
    ] = None,
    limit: Annotated[int | None, typer.Option(min=1, help="Stop after so many images.")] = None,
) -> None:
    """Find markers; with --size and --camera, measure where they are."""
    from tagmetry.cli.report import explain_lines, result_lines
    from tagmetry.record import format_line

    task = measurement(
        family,
        size,
        camera,
        inverted=inverted,
        forgive_bits=forgive_bits,
        min_side_px=min_side,
    )
    with ExitStack() as stack:
        takers = _Takers(stack, out, overlay, cube, task)
        for image in _images(sources, task, limit):
            result, rejections = _measured(task, image, explain)
            takers.take(image, result, rejections)
            if json:
                typer.echo(format_line(result))
            elif out != "-":
                typer.echo("\n".join([*result_lines(result), *explain_lines(rejections)]))


class _Takers:
    """The files that results go to."""

    def __init__(
        self,
        stack: ExitStack,
        out: str | None,
        overlay: Path | None,
        cube: bool,
        task: "Measurement",
    ) -> None:
        from tagmetry.record import open_overlay, open_writer

        self._results: Writer[ImageResult] | None = None
        self._overlays: Writer[Image] | None = None
        self._cube = cube
        self._task = task
        if out is not None:
            self._results = stack.enter_context(open_writer(out))
        if overlay is not None:
            self._overlays = stack.enter_context(open_overlay(overlay))

    def take(
        self, image: "Image", result: "ImageResult", rejections: tuple["Rejection", ...]
    ) -> None:
        """Write one image's result and its overlay."""
        from tagmetry.record import draw_overlay

        if self._results is not None:
            self._results.write(result)
        if self._overlays is not None:
            drawn = draw_overlay(
                image.pixels,
                [marker.detection for marker in result.markers],
                [marker.pose for marker in result.markers],
                self._task.camera,
                cube=self._cube,
                rejections=rejections,
            )
            self._overlays.write(replace(image, pixels=drawn))


def _measured(
    task: "Measurement", image: "Image", explain: bool
) -> tuple["ImageResult", tuple["Rejection", ...]]:
    if not explain:
        return task.measure(image), ()
    findings = task.explain(image)
    return task.result(image, findings.detections), findings.rejections


def _images(sources: list[str], task: "Measurement", limit: int | None) -> Iterator["Image"]:
    """Give the images of all sources one after another, numbered through."""
    from tagmetry.cli.progress import progress
    from tagmetry.sources import open_source

    count = 0
    for spec in sources:
        with open_source(spec, camera=task.camera, on_state=_tell_state) as source:
            first = count
            for image in progress(source):
                yield replace(image, sequence=first + image.sequence)
                count = first + image.sequence + 1
                if limit is not None and count >= limit:
                    return
            _tell_warnings(source)


def _tell_state(state: object) -> None:
    typer.echo(f"tagmetry: {state}", err=True)


def _tell_warnings(source: "Source") -> None:
    from tagmetry.sources import VideoFile

    if isinstance(source, VideoFile):
        for warning in source.warnings:
            typer.echo(f"tagmetry: {source.name}: {warning}", err=True)

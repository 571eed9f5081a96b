"""`tagmetry detect`: markers and their poses from pictures, videos and cameras."""

from collections.abc import Generator
from contextlib import ExitStack, closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.options import CameraFile, Families, Inverted, Json, Size, first, measurement

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
            metavar="SOURCE",
            help="Picture, folder, glob, video, camera number, /dev/video0, rtsp://, http://, or a "
            "simulated camera or scene: twin:webcam, twin:room, twin:desk.yaml.",
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
    stages: Annotated[
        Path | None,
        typer.Option(help="Folder for pictures of every stage of the first image, and index.html."),
    ] = None,
    json: Json = False,
    explain: Annotated[
        bool, typer.Option("--explain", help="Say why squares were turned down.")
    ] = False,
    marker: Annotated[
        str | None, typer.Option(help="For .tum: whose trajectory, e.g. tag36h11:7.")
    ] = None,
    cube: Annotated[bool, typer.Option("--cube", help="Draw a cube on every marker.")] = False,
    inverted: Inverted = False,
    forgive_bits: Annotated[
        int | None, typer.Option(help="Wrong bits to forgive; by default as the family allows.")
    ] = None,
    min_side: Annotated[
        float | None, typer.Option(help="Smallest side of a marker to look for, in pixels.")
    ] = None,
    track: Annotated[
        bool,
        typer.Option("--track", help="Follow markers from image to image: quicker in videos."),
    ] = False,
    limit: Annotated[int | None, typer.Option(min=1, help="Stop after so many images.")] = None,
) -> None:
    """Find markers; with --size and --camera, measure where they are."""
    from tagmetry.cli.interrupts import held_back
    from tagmetry.cli.report import explain_lines, json_line, result_lines
    from tagmetry.cli.warmup import tell_compiling
    from tagmetry.errors import InputError

    task = measurement(
        family,
        size,
        camera,
        inverted=inverted,
        forgive_bits=forgive_bits,
        min_side_px=min_side,
        track=track,
    )
    if track and explain:
        raise InputError("--explain looks at whole images, --track does not; leave one of them out")
    if out == "-":
        json, out = True, None
    if _lacks_poses(task, out, sources):
        typer.echo("tagmetry: no poses: they need both --size and --camera", err=True)
    tell_compiling()
    sights = _FirstStages(stages, task)
    with ExitStack() as stack:
        takers = _Takers(stack, _results_writer(out, marker), overlay, cube, task)
        images = stack.enter_context(closing(_images(sources, task)))
        for image in first(images, limit):
            with held_back():
                sights.take(image)
                result, rejections = _measured(task, image, explain)
                takers.take(image, result, rejections)
                if json:
                    typer.echo(json_line(result, rejections if explain else None).encode())
                else:
                    typer.echo("\n".join([*result_lines(result), *explain_lines(rejections)]))


class _Takers:
    """The files that results go to."""

    def __init__(
        self,
        stack: ExitStack,
        results: "Writer[ImageResult] | None",
        overlay: Path | None,
        cube: bool,
        task: "Measurement",
    ) -> None:
        from tagmetry.record import open_overlay

        self._results = stack.enter_context(results) if results is not None else None
        self._overlays: Writer[Image] | None = None
        self._cube = cube
        self._task = task
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


class _FirstStages:
    """The folder that pictures of the first image's stages go to."""

    def __init__(self, folder: Path | None, task: "Measurement") -> None:
        self._folder = folder
        self._task = task

    def take(self, image: "Image") -> None:
        """Write the stages of the first image that comes."""
        if self._folder is None:
            return
        from tagmetry.record.stages import write_stages

        write_stages(self._task.look_through(image), self._folder)
        self._folder = None


def _measured(
    task: "Measurement", image: "Image", explain: bool
) -> tuple["ImageResult", tuple["Rejection", ...]]:
    if not explain:
        return task.measure(image), ()
    findings = task.explain(image)
    return task.result(image, findings.detections), findings.rejections


def _lacks_poses(task: "Measurement", out: str | None, sources: list[str]) -> bool:
    """Say whether poses are wanted and cannot be had."""
    from tagmetry.pipeline import tells_camera

    given = (task.sizes_m is not None) + (task.camera is not None)
    if task.sizes_m is not None and all(tells_camera(spec) for spec in sources):
        return False
    return given == 1 or (given == 0 and out is not None and out.lower().endswith(".tum"))


def _results_writer(out: str | None, marker: str | None) -> "Writer[ImageResult] | None":
    """Return what writes the results; `marker` is of the form FAMILY:ID."""
    from tagmetry.errors import InputError
    from tagmetry.record import open_writer

    if out is None:
        return None
    if marker is None:
        return open_writer(out)
    family, _, number = marker.rpartition(":")
    if not (family and number.isascii() and number.isdigit()):
        raise InputError(f"expected a marker like tag36h11:7, found {marker[:40]!r}")
    return open_writer(out, marker=(family, int(number)))


def _images(sources: list[str], task: "Measurement") -> Generator["Image"]:
    """Give the images of all sources one after another, numbered through."""
    from tagmetry.cli.live_state import StateTeller
    from tagmetry.cli.progress import progress
    from tagmetry.pipeline import open_images

    count = 0
    for spec in sources:
        with open_images(spec, camera=task.camera, on_state=StateTeller(spec)) as source:
            first = count
            task.begin_source()
            for image in progress(source):
                yield replace(image, sequence=first + image.sequence)
                count = first + image.sequence + 1
            _tell_warnings(source)


def _tell_warnings(source: "Source") -> None:
    from tagmetry.sources import VideoFile

    if isinstance(source, VideoFile):
        for warning in source.warnings:
            typer.echo(f"tagmetry: {source.name}: {warning}", err=True)

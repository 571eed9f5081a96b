"""`tagmetry doctor`: why is nothing, or something wrong, found in a picture?"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from tagmetry.camera import Camera
    from tagmetry.detect.doctor import Advice
    from tagmetry.geometry.arrays import AnyPixels
    from tagmetry.markers import MarkerFamily

Picture = Annotated[list[Path], typer.Argument(help="Pictures to look at.", metavar="PICTURE")]
Family = Annotated[
    list[str] | None,
    typer.Option(help="Family asked for; may be repeated. All families when left out."),
]
CameraFile = Annotated[Path | None, typer.Option(help="Intrinsics that go with the pictures.")]
Size = Annotated[
    str | None, typer.Option(help="Side of the black square: 0.12, 120mm, 7=0.05,8=0.12.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print one JSON line per picture.")]


def doctor(
    pictures: Picture,
    *,
    family: Family = None,
    camera: CameraFile = None,
    size: Size = None,
    as_json: AsJson = False,
) -> None:
    """Say in words why nothing, or something wrong, is found."""
    from tagmetry.errors import InputError
    from tagmetry.files import load_camera, resolve_family
    from tagmetry.files.lengths import parse_sizes_m
    from tagmetry.sources import read_picture

    if size and not camera:
        raise InputError("--size is judged together with a calibration: give --camera too")
    families = tuple(resolve_family(name) for name in family or ())
    intrinsics = load_camera(camera) if camera else None
    sizes_m = parse_sizes_m(size) if size else None
    for path in pictures:
        pixels = read_picture(path)
        advice = _advice(path, pixels, families, intrinsics, sizes_m)
        typer.echo(_line(path, pixels, advice) if as_json else _block(path, pixels, advice))


def _advice(
    path: Path,
    pixels: "AnyPixels",
    families: Sequence["MarkerFamily"],
    camera: "Camera | None",
    sizes_m: float | dict[int, float] | None,
) -> tuple["Advice", ...]:
    from tagmetry.detect.doctor import diagnose, problems_first
    from tagmetry.errors import InputError

    try:
        advice = diagnose(pixels, families, camera)
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    if camera is None or sizes_m is None or camera.size_px != pixels.shape[1::-1]:
        return advice
    return problems_first((*advice, *_distances(pixels, families, camera, sizes_m)))


def _distances(
    pixels: "AnyPixels",
    families: Sequence["MarkerFamily"],
    camera: "Camera",
    sizes_m: float | dict[int, float],
) -> tuple["Advice", ...]:
    """Measure the markers that have a size, and judge their distances."""
    import numpy as np

    from tagmetry.detect.doctor import MeasuredMarker, check_distances, found_markers
    from tagmetry.pose import estimate_pose

    measured = []
    for detection in found_markers(pixels, families):
        size_m = sizes_m.get(detection.id) if isinstance(sizes_m, dict) else sizes_m
        pose = estimate_pose(detection, camera, size_m) if size_m else None
        if pose and pose.hypotheses:
            distance_m = float(np.linalg.norm(pose.best.T_camera_marker.translation))
            name = f"{detection.family} id {detection.id}"
            measured.append(MeasuredMarker(name, pose.size_m, distance_m, pose.ambiguity))
    return check_distances(measured)


def _block(path: Path, pixels: "AnyPixels", advice: Sequence["Advice"]) -> str:
    height_px, width_px = pixels.shape[:2]
    lines = [f"{path} ({width_px}x{height_px})"]
    for one in advice:
        lines.append(f"  {one.severity + ':':9}{one.title}: {one.explanation}")
        if one.remedy:
            lines.append(f"  {'':9}-> {one.remedy}")
    return "\n".join(lines)


def _line(path: Path, pixels: "AnyPixels", advice: Sequence["Advice"]) -> str:
    import json
    from dataclasses import asdict

    height_px, width_px = pixels.shape[:2]
    size = {"width": width_px, "height": height_px}
    return json.dumps({"source": str(path), **size, "advice": [asdict(one) for one in advice]})

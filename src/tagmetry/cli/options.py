"""Options that several subcommands share."""

import sys
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, TypeVar

import typer

if TYPE_CHECKING:
    from tagmetry.pipeline import Measurement

Families = Annotated[
    list[str],
    typer.Option(
        "--family", help="Family to look for, or a dictionary file; may be given several times."
    ),
]
Size = Annotated[
    str | None,
    typer.Option(help="Side of the black squares: 0.12, 120mm, 12cm; by id: 7=0.05,8=12cm."),
]
CameraFile = Annotated[
    Path | None, typer.Option("--camera", help="Camera file: ROS, OpenCV or Kalibr.")
]
Inverted = Annotated[bool, typer.Option("--inverted", help="Find white on black markers too.")]
Json = Annotated[bool, typer.Option("--json", help="Print JSON instead of text.")]


Item = TypeVar("Item")


def first(items: Iterable[Item], count: int | None) -> Iterator[Item]:
    """Give so many items, all where None; no count is too large."""
    return islice(items, count if count is None else min(count, sys.maxsize))


def measurement(
    families: list[str],
    size: str | None = None,
    camera: Path | None = None,
    *,
    inverted: bool = False,
    forgive_bits: int | None = None,
    min_side_px: float | None = None,
    track: bool = False,
) -> "Measurement":
    """Return the measurement that the options ask for."""
    from tagmetry.detect import Detector, Tracker
    from tagmetry.files import load_camera, resolve_family
    from tagmetry.files.lengths import parse_sizes_m
    from tagmetry.pipeline import Measurement

    detector = Detector(
        [resolve_family(name) for name in families],
        forgive_bits=forgive_bits,
        inverted=inverted,
        min_side_px=min_side_px,
    )
    return Measurement(
        detector,
        camera=load_camera(camera) if camera is not None else None,
        sizes_m=parse_sizes_m(size) if size is not None else None,
        tracker=Tracker(detector) if track else None,
    )


def check_png(picture: Path | None) -> None:
    """Refuse a picture that is to be written as another format than PNG, or where none can be."""
    from tagmetry.errors import InputError
    from tagmetry.files.atomic import check_destinations

    if picture is not None and picture.suffix.lower() != ".png":
        raise InputError(f"the picture is a PNG; name it like map.png, got {picture.name[-40:]}")
    check_destinations(picture)

"""`tagmetry locate`: where a camera is, by markers whose places are known."""

from collections.abc import Generator
from contextlib import ExitStack, closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from tagmetry.cli.deviations import decimals_of
from tagmetry.cli.options import CameraFile, Inverted, Json, Size, check_png, first

if TYPE_CHECKING:
    from tagmetry.camera import Image
    from tagmetry.geometry import Array, RigidTransform
    from tagmetry.localize import MarkerMap, PlanarRobot
    from tagmetry.pipeline.location import Located, Location


def locate(  # noqa: PLR0913 (each argument is an option)
    *,
    sources: Annotated[
        list[str],
        typer.Argument(
            metavar="SOURCE",
            help="Picture, folder, glob, video, camera number, /dev/video0, rtsp://, http://, or a "
            "simulated camera or scene: twin:room.",
        ),
    ],
    map_file: Annotated[
        Path,
        typer.Option(
            "--map", help="Marker map: ours, WPILib, apriltag_ros tags.yaml, TagSLAM, ArUco."
        ),
    ],
    camera: CameraFile = None,
    family: Annotated[
        str | None, typer.Option(help="Family of the markers, where the map does not say it.")
    ] = None,
    size: Size = None,
    bundle: Annotated[
        str | None, typer.Option(help="Which bundle of an apriltag_ros file.")
    ] = None,
    method: Annotated[
        str, typer.Option(help="single, mean, weighted, covariance, joint or filter.")
    ] = "joint",
    planar: Annotated[
        str | None,
        typer.Option(
            help="The camera rides on a robot on a level floor: its place and where it looks, like "
            "x=12cm,z=0.4,up=25."
        ),
    ] = None,
    odometry: Annotated[
        Path | None,
        typer.Option(help="For the filter: CSV with time_s, forward_m_s, left_m_s, turn_rad_s."),
    ] = None,
    out: Annotated[
        str | None, typer.Option(help="Poses: .jsonl or .tum; - for JSON lines here.")
    ] = None,
    picture: Annotated[
        Path | None, typer.Option(help="The map and the camera's way, from above and in 3-D: .png.")
    ] = None,
    json: Json = False,
    inverted: Inverted = False,
    limit: Annotated[int | None, typer.Option(min=1, help="Stop after so many images.")] = None,
) -> None:
    """Say where the camera is in the world of a marker map."""
    from tagmetry.cli.interrupts import held_back
    from tagmetry.cli.planar import parse_planar
    from tagmetry.pipeline.location_files import location_line, open_location_writer

    if out == "-":
        json, out = True, None
    check_png(picture)
    marker_map = _map(map_file, family, size, bundle)
    robot = parse_planar(planar) if planar is not None else None
    task = _location(marker_map, camera, method, robot, odometry, inverted=inverted)
    way: list[Located] = []
    with ExitStack() as stack:
        writer = stack.enter_context(open_location_writer(out)) if out is not None else None
        images = stack.enter_context(closing(_images(sources, task)))
        for image in first(images, limit):
            with held_back():
                found = task.locate(image)
                way.append(found)
                if writer is not None:
                    writer.write(found)
                typer.echo(location_line(found) if json else _told(found))
    if picture is not None:
        _draw(picture, marker_map, way)


def _map(path: Path, family: str | None, size: str | None, bundle: str | None) -> "MarkerMap":
    from tagmetry.files.lengths import parse_sizes_m
    from tagmetry.files.maps import MapDefaults, load_map

    sizes_m = parse_sizes_m(size) if size is not None else None
    return load_map(path, MapDefaults(family, sizes_m), bundle)


def _location(
    marker_map: "MarkerMap",
    camera: Path | None,
    method: str,
    robot: "PlanarRobot | None",
    odometry: Path | None,
    *,
    inverted: bool,
) -> "Location":
    from tagmetry.detect import Detector
    from tagmetry.errors import InputError
    from tagmetry.files import load_camera, resolve_family
    from tagmetry.localize import METHODS, Knowledge
    from tagmetry.localize.filter import PoseFilter
    from tagmetry.pipeline.location import Location
    from tagmetry.pipeline.location_odometry import load_odometry

    if method not in (*METHODS, "filter"):
        raise InputError(f"there is no method {method!r}; there are {', '.join(METHODS)}, filter")
    if odometry is not None and (robot is None or method != "filter"):
        raise InputError("odometry needs --method filter, and --planar for the camera's place")
    speeds = load_odometry(odometry, robot.T_robot_camera) if odometry and robot else []
    return Location(
        Detector([resolve_family(name) for name in marker_map.families], inverted=inverted),
        marker_map,
        load_camera(camera) if camera is not None else None,
        METHODS["joint" if method == "filter" else method],
        robot.knowledge if robot is not None else Knowledge(),
        PoseFilter() if method == "filter" else None,
        speeds,
    )


def _images(sources: list[str], task: "Location") -> Generator["Image"]:
    """Give the images of all sources one after another, numbered through."""
    from tagmetry.cli.live_state import StateTeller
    from tagmetry.cli.progress import progress
    from tagmetry.pipeline import open_images

    count = 0
    for spec in sources:
        with open_images(spec, camera=task.camera, on_state=StateTeller(spec)) as source:
            first = count
            for image in progress(source):
                yield replace(image, sequence=first + image.sequence)
                count = first + image.sequence + 1


def _told(found: "Located") -> str:
    """Return one line for people."""
    head = f"{found.source} [{found.sequence}]:"
    T = found.T_world_camera
    if T is None:
        return f"{head} no pose: {found.why}"
    count = len(found.used)
    told = f"{head} {_place(T.translation, found.covariance)}, {_aim(T, found.covariance)}, "
    told += f"{count} marker{'' if count == 1 else 's'}"
    if found.age_s > 0:
        told += f", {found.age_s:.2f} s after the last"
    if found.probability < 0.95:
        told += f", ambiguous: {100 * found.probability:.0f} % sure"
    if found.rejected:
        told += f", {len(found.rejected)} not used"
    return told


def _place(p_world: "Array", covariance: "Array") -> str:
    """Return a camera's place with one deviation of it as a distance."""
    deviation_mm = 1000 * float(covariance.diagonal()[:3].sum() ** 0.5)
    decimals = decimals_of(deviation_mm)
    x, y, z = (f"{value:z.{decimals + 3}f}" for value in p_world)
    return f"x {x} y {y} z {z} m (± {deviation_mm:.{decimals}f} mm)"


def _aim(T_world_camera: "RigidTransform", covariance: "Array") -> str:
    """Return where a camera looks: degrees from the world's x toward y, and up or down."""
    import numpy as np

    x, y, z = T_world_camera.rotation.as_matrix()[:, 2]
    round_deg, up_deg = np.degrees([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))])
    deviation_deg = np.degrees(np.sqrt(covariance.diagonal()[3:].sum()))
    decimals = decimals_of(deviation_deg)
    height = f"{abs(up_deg):.{decimals}f}° {'down' if up_deg < 0 else 'up'}"
    return f"looks {round_deg:z.{decimals}f}° round, {height} (± {deviation_deg:.{decimals}f}°)"


def _draw(path: Path, marker_map: "MarkerMap", way: list["Located"]) -> None:
    from tagmetry.files import write_atomically
    from tagmetry.record.map_drawing import map_picture

    poses = [found.T_world_camera for found in way if found.T_world_camera is not None]
    write_atomically(path, map_picture(marker_map, poses))

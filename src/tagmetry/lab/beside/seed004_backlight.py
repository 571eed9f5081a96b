"""Backlight beside what seed 004 says of its figure 8."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.beside.sample import Sample, rounded, sample
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed004 import seed004
from tagmetry.lab.rigs.robot_cameras import CameraName, robot_picture
from tagmetry.lab.rigs.robot_room import T_ROBOT_CAMERA, RobotStand, robot_place, room_scene
from tagmetry.lab.rows import RobotPlace
from tagmetry.record.report import ReportFigure, ReportTable
from tagmetry.record.report.plot import blank

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DAYLIGHT = 100.0  # times as bright as paper in a room
_CAMERAS: tuple[CameraName, ...] = ("webcam", "HDR, normal")
_SETUP = (
    "The marker hangs on a pillar between windows that fill the rest of the picture. The webcam "
    "exposes by itself and leaves the pillar dark; the other camera is set to the room, and its "
    "response bends twice. Half a percent of all light is scattered in either lens. Where paper "
    "comes above the bend, black and white are no longer in proportion, edges seem to move, and "
    "errors exceed what the covariance says."
)


def conclude(rows: Sequence[RobotPlace]) -> Conclusions:
    """Return whether the marker is found, how exactly, and figure 8."""
    everything = sample(rows)
    return Conclusions(
        checks=_checks(everything.where(window=_DAYLIGHT)),
        tables=(_table(everything),),
        figures=(_figure(),),
        remarks=(_SETUP, seed004().remarks[0]),
    )


def _checks(daylight: Sample) -> tuple[Check, ...]:
    (words,) = seed004().words(8)
    webcam, hdr = (daylight.where(camera=camera) for camera in _CAMERAS)
    return (
        Check(
            f"webcam, the paper's detector: {words}",
            "found in no picture",
            _found(webcam.paper),
            _share(webcam.paper) == 0,
        ),
        Check("webcam, ours", "nothing is asked", _found(webcam.ours), None),
        Check(f"HDR, ours: {words}", "found in all", _found(hdr.ours), _share(hdr.ours) == 1),
    )


def _share(part: Sample) -> float:
    return float(np.isfinite(part.values("place_m")).mean())


def _found(part: Sample) -> str:
    mean = part.mean("place_m")
    told = f"{mean.count} of {mean.count + mean.missing}"
    return f"{told}, {rounded(1000 * mean.mean):g} mm off" if mean.count else told


def _table(everything: Sample) -> ReportTable:
    lines = tuple(
        (camera, window, _found(here.ours), _found(here.paper))
        for camera in _CAMERAS
        for window, here in everything.where(camera=camera).by("window").items()
    )
    header = ("camera", "windows by paper", "ours: found", "the paper's steps: found")
    return ReportTable("seed004_backlight", "Figure 8: against the light", header, lines)


def _figure() -> ReportFigure:
    def draw() -> "Figure":
        figure, _ = blank(8.8, 3.4)
        figure.clear()
        for axes, camera in zip(figure.subplots(1, 2), _CAMERAS, strict=True):
            stand, rng = RobotStand("one", 0.10, 1.0, window=_DAYLIGHT), np.random.default_rng(0)
            place = robot_place(stand, rng) * T_ROBOT_CAMERA
            axes.imshow(
                robot_picture(camera, room_scene(stand), place, rng), "gray", vmin=0, vmax=255
            )
            axes.set_title(camera, fontsize=9)
            axes.axis("off")
        return figure

    return ReportFigure(
        "seed004_figure8",
        "Figure 8: strong light beside the marker",
        f"Windows {_DAYLIGHT:.0f} times as bright as paper, as the twin renders them.",
        draw,
    )

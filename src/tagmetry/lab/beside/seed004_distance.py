"""Distance, camera and number of markers beside what seed 004 says of its figures 7 and 10."""

from collections.abc import Iterator, Sequence
from typing import get_args

import numpy as np

from tagmetry.lab.beside.curves import Curve, Plot, curve_figure
from tagmetry.lab.beside.sample import Mean, Sample, difference, found_of, rounded, sample, told_of
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed004 import seed004
from tagmetry.lab.rigs.robot_cameras import CameraName
from tagmetry.lab.rows import RobotPlace
from tagmetry.record.report import Cell, ReportFigure, ReportTable

_LARGE_M, _SMALL_M = 0.10, 0.06
_GOOD_M = 0.01
_CAMERAS: tuple[CameraName, ...] = get_args(CameraName)
_PLOTS = (Plot("place_m", "distance_m"), Plot("heading_deg", "distance_m"))
_SETUP = (
    "The camera is level, as high as the markers' middles, and looks straight at them: where left "
    "and right turns look most alike. Angles of view and the sensors' noise are taken (60, 45 and "
    "80 degrees across); the robot stands up to 5 mm and 0.5 degrees off at random. Ours knows "
    "that the robot stands on the floor; the paper's steps take the camera as level too."
)


def conclude(rows: Sequence[RobotPlace]) -> Conclusions:
    """Return what the text says, errors by distance and by method, and figures 7 and 10."""
    everything = sample(rows)
    large, small = everything.where(size_m=_LARGE_M), everything.where(size_m=_SMALL_M)
    return Conclusions(
        checks=(*_camera_checks(large), *_count_checks(small), *_paper_checks(everything)),
        tables=(_by_distance(everything), _by_method(everything)),
        figures=tuple(_figures(large, small)),
        remarks=(_SETUP, *seed004().remarks),
    )


def _camera_checks(large: Sample) -> Iterator[Check]:
    good, shrinks, better = seed004().words(7)
    for camera in _CAMERAS:
        near = large.ours.where(camera=camera).within(0.0, 1.0)
        means = [one.mean("place_m") for one in near.by("distance_m").values()]
        worst = max(means, key=lambda one: (one.missing, one.high))
        yield Check(
            f"{camera}: {good}",
            f"at most {1000 * _GOOD_M:.0f} mm",
            told_of(worst, 1000.0, "mm"),
            bool(worst.missing == 0 and worst.high <= _GOOD_M),
        )
    wide = large.ours.where(camera="HDR, wide")
    yield _trend(shrinks, wide.within(1.05, 1.5), wide.within(0.0, 1.0), "place_m")
    normal, webcam = (large.ours.where(camera=one) for one in ("HDR, normal", "webcam"))
    yield _trend(better, normal, webcam, "place_m")


def _count_checks(small: Sample) -> Iterator[Check]:
    (words,) = seed004().words(10)
    one, two = (small.ours.where(layout=layout) for layout in ("one", "two"))
    yield _trend(f"place: {words}", one, two, "place_m")
    yield _trend(f"direction: {words}", one, two, "heading_deg")


def _paper_checks(everything: Sample) -> Iterator[Check]:
    for name, field in (("place", "place_m"), ("heading", "heading_deg")):
        ours, theirs = (_rms(part, field) for part in (everything.ours, everything.paper))
        yield Check(
            f"rms error of the {name} over all pictures, by that of the paper's steps in the same",
            "at most half",
            f"{ours / theirs:.3f}",
            bool(ours <= 0.5 * theirs),
        )


def _rms(part: Sample, field: str) -> float:
    return float(np.sqrt(np.nanmean(part.values(field) ** 2)))


def _trend(told: str, worse: Sample, better: Sample, field: str) -> Check:
    scale, unit = (1000.0, "mm") if field == "place_m" else (1.0, "degrees")
    gain = difference(worse.values(field), better.values(field))
    of = rounded(scale * float(np.nanmean(worse.values(field))))
    return Check(
        f"trend: {told}",
        "a difference above 0, with 95 % confidence",
        f"{told_of(gain, scale, unit)} of {of:g}",
        bool(gain.low > 0),
    )


def _by_distance(everything: Sample) -> ReportTable:
    header = (
        "camera", "markers", "distance cm", "ours: place mm", "± mm", "heading degrees",
        "localized", "the paper's steps: place mm", "± mm", "heading degrees", "localized",
    )  # fmt: skip
    lines = tuple(
        (camera, name, round(100 * distance_m), *_numbers(here.ours), *_numbers(here.paper))
        for camera, name, part in _settings(everything)
        for distance_m, here in part.by("distance_m").items()
    )
    return ReportTable("seed004_distance", "Figures 7 and 10: errors by distance", header, lines)


def _numbers(part: Sample) -> Iterator[Cell]:
    place: Mean = part.mean("place_m")
    yield rounded(1000 * place.mean)
    yield rounded(1000 * place.half)
    yield rounded(part.mean("heading_deg").mean)
    yield found_of(place)


def _settings(everything: Sample) -> Iterator[tuple[str, str, Sample]]:
    """Give camera, markers and pictures of every curve."""
    for camera in _CAMERAS:
        for layout, size_m in (("one", _LARGE_M), ("one", _SMALL_M), ("two", _SMALL_M)):
            part = everything.where(camera=camera, layout=layout, size_m=size_m)
            if part.rows:
                yield camera, f"{layout} of {100 * size_m:.0f} cm", part


def _by_method(everything: Sample) -> ReportTable:
    """Return the error of every method over 100 to 150 cm."""
    settings = list(_settings(everything))
    far = [part.within(1.0, 1.5) for *_, part in settings]
    lines = tuple(
        (
            method,
            *(told_of(part.where(method=method).mean("place_m"), 1000.0, "") for part in far),
        )
        for method in everything.methods
    )
    header = ("method", *(f"{camera}: {name}" for camera, name, _ in settings))
    title = "Error of the place by every method, 100 to 150 cm: mean ± its 95 % confidence, mm"
    return ReportTable("seed004_methods", title, header, lines)


def _figures(large: Sample, small: Sample) -> Iterator[ReportFigure]:
    cameras = [large.where(camera=camera) for camera in _CAMERAS]
    counts = [small.where(layout=layout) for layout in ("one", "two")]
    yield curve_figure(7, "one marker of 10 cm", _curves(_CAMERAS, cameras), _PLOTS, seed="seed004")
    yield curve_figure(
        10, "one and two markers of 6 cm", _curves(("one", "two"), counts), _PLOTS, seed="seed004"
    )


def _curves(names: Sequence[str], parts: Sequence[Sample]) -> tuple[Curve, ...]:
    both = list(enumerate(zip(names, parts, strict=True)))
    ours = [Curve(f"{name}, ours", part.ours, color) for color, (name, part) in both]
    theirs = [
        Curve(f"{name}, its steps", part.paper, color, dashed=True) for color, (name, part) in both
    ]
    return (*ours, *theirs)

"""From the image to squares: the steps that see all of it."""

from collections.abc import Iterator

import numpy as np

from tagmetry.detect.stages import Stages
from tagmetry.detect.stages.parted import Parted
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.record.drawing import Pen, draw_path
from tagmetry.record.palette import ORANGE, PURPLE, SKY_BLUE, VERMILLION
from tagmetry.record.stages.panel import Panel, shown


def segmentation_panels(stages: Stages) -> Iterator[Panel]:
    """Give the pictures of grey, half scale, levels, mask, areas, outlines and squares."""
    seen = stages.parted
    height, width = stages.grey.shape
    yield Panel(
        "grey",
        "Grey",
        f"{width} x {height} pixels. Colour says nothing of black and white markers.",
        shown(stages.grey),
    )
    yield Panel(
        "half",
        "Half scale",
        "Means of 2 x 2 pixels: half the noise, a quarter of the work. Small markers are looked "
        "for at full scale too.",
        shown(seen.grey),
    )
    yield _levels(seen)
    yield Panel(
        "mask",
        "Dark pixels",
        "What is darker than its tile's level. Plain tiles have no dark pixels.",
        shown(np.where(seen.is_dark, 0, 255).astype(np.uint8)),
    )
    yield _areas(seen)
    yield _outlines(seen)
    yield _squares(stages)


def _levels(seen: Parted) -> Panel:
    plain = (seen.level == 0).mean()
    return Panel(
        "levels",
        "Levels",
        "Midway between the darkest and the brightest of a tile of 4 x 4 pixels and its "
        "neighbours. Black: plain tiles, whose contrast is below the noise gate of "
        f"{seen.gate:.0f} grey values ({plain:.0%} of the image).",
        shown(seen.level),
    )


def _areas(seen: Parted) -> Panel:
    canvas = _pale(seen.grey)
    times = canvas.shape[1] // seen.grey.shape[1]
    kinds = zip(seen.boxes.tolist(), seen.begins, seen.is_likely, strict=True)
    for box, begins, likely in kinds:
        color = ORANGE if likely else SKY_BLUE if begins else PURPLE
        draw_path(canvas, _box_corners(box) * times, Pen(color, rim_px=0), closed=True)
    return Panel(
        "areas",
        "Dark areas",
        f"{len(seen.boxes)} areas of pixels that touch. Purple: those whose first pixel stands at "
        f"no clear step from bright to dark; nothing more is done about them. The outlines of "
        f"{seen.begins.sum()} are walked. Orange: {seen.is_likely.sum()} that are large enough and "
        "make no detours.",
        canvas,
    )


def _box_corners(box: list[int]) -> Array:
    left, top, width, height = box
    corners = [[left, top], [left + width, top], [left + width, top + height], [left, top + height]]
    return np.array(corners, dtype=np.float64)


def _outlines(seen: Parted) -> Panel:
    canvas = _pale(seen.grey)
    times = canvas.shape[1] // seen.grey.shape[1]
    walked = [line for line, likely in zip(seen.outlines, seen.is_likely, strict=True) if likely]
    for line in walked:
        draw_path(canvas, (line + 0.5) * times - 0.5, Pen(SKY_BLUE, rim_px=0), closed=True)
    points = sum(len(line) for line in walked)
    return Panel(
        "outlines",
        "Outlines",
        f"Those of the likely areas: {points} pixels of {seen.grey.size}. On every step the place "
        "between two pixels is noted where the grey values pass the level.",
        canvas,
    )


def _squares(stages: Stages) -> Panel:
    canvas = _pale(stages.grey)
    times = canvas.shape[1] // stages.grey.shape[1]
    found = stages.squares
    for corners_px, bright in zip(found.corners_px, found.is_bright, strict=True):
        color = SKY_BLUE if bright else VERMILLION
        place = (corners_px + 0.5) * times - 0.5
        draw_path(canvas, place, Pen(color, rim_px=0), closed=True)
    bright = int(found.is_bright.sum())
    return Panel(
        "squares",
        "Squares",
        "Outlines that four fitted lines describe, of all looks at all scales: "
        f"{len(found.is_bright) - bright} dark ones (red) and {bright} bright ones (blue), which "
        "only inverted markers and white borders need.",
        canvas,
    )


def _pale(grey: GreyPixels) -> GreyPixels:
    """Return a grey picture with little contrast, so that lines stand out."""
    return shown((grey // 2 + 96).astype(np.uint8))

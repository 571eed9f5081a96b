"""How one marker is read: the cells, what they say, and who it is."""

from collections.abc import Iterator

import numpy as np

from tagmetry.detect.stages import Stages
from tagmetry.detect.stages.stages import OneMarker
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.record.drawing import Pen, draw_dot, draw_path, draw_text
from tagmetry.record.overlay import draw_overlay
from tagmetry.record.palette import DARK, ORANGE, SKY_BLUE, VERMILLION, WHITE, YELLOW
from tagmetry.record.stages.closeup import Closeup
from tagmetry.record.stages.panel import Panel

_WIDTH_PX = 640
_AROUND = 0.08  # of the marker's extent


def reading_panels(stages: Stages) -> Iterator[Panel]:
    """Give the pictures of cells and bits, and of all ids."""
    if stages.shown is not None:
        yield _cells(stages.grey, stages.shown)
        yield _bits(stages.grey, stages.shown)
    found, others = stages.findings.detections, stages.findings.rejections
    yield Panel(
        "ids",
        "Identified",
        f"{len(found)} markers; the dot is a marker's own top left. {len(others)} other squares "
        "are no markers.",
        draw_overlay(stages.image, found),
    )


def marker_closeup(grey: GreyPixels, one: OneMarker) -> Closeup:
    """Return the part of an image that shows a marker."""
    places = np.concatenate([one.sampled.bits_px, one.sampled.white_px, one.first_px])
    low, high = places.min(axis=0), places.max(axis=0)
    around = _AROUND * (high - low)
    return Closeup.around(grey, low - around, high + around, _WIDTH_PX)


def _cells(grey: GreyPixels, one: OneMarker) -> Panel:
    view, read = marker_closeup(grey, one), one.sampled
    draw_path(view.canvas, view.at(one.first_px), Pen(ORANGE, 2), closed=True)
    kinds: tuple[tuple[Array, tuple[int, int, int]], ...] = (
        (read.black_px, SKY_BLUE),
        (read.white_px, VERMILLION),
        (read.bits_px, YELLOW),
    )
    for places, color in kinds:
        for place in view.at(places):
            draw_dot(view.canvas, place, 3.0, color)
    (black0, white0), (black1, white1) = read.levels.min(axis=0), read.levels.max(axis=0)
    return Panel(
        "cells",
        "Cells",
        "The square's homography says where each cell is. Blue: black for certain, a plane from "
        f"{black0:.0f} to {black1:.0f}. Red: white for certain, a plane from {white0:.0f} to "
        f"{white1:.0f}. Yellow: the bits, each held against the middle of both planes there.",
        view.canvas,
    )


def _bits(grey: GreyPixels, one: OneMarker) -> Panel:
    view, read = marker_closeup(grey, one), one.sampled
    size_px = max(9.0, 0.018 * _WIDTH_PX)
    for place, margin, white in zip(
        view.at(read.bits_px), read.margins, read.is_white, strict=True
    ):
        draw_dot(view.canvas, place, 1.3 * size_px, WHITE if white else DARK)
        draw_text(view.canvas, f"{margin:+.1f}", place - [0, size_px / 2], size_px, YELLOW)
    family, found = one.family, one.detection
    return Panel(
        "bits",
        "Bits",
        "Value minus threshold by half the contrast: +1 is paper, -1 is ink. Nearest of all "
        f"{4 * len(family)} turned codes: {family.name} id {found.id}, {found.hamming} wrong bits "
        f"({family.forgiven_bits} are forgiven), confidence {found.confidence:.2f}.",
        view.canvas,
    )

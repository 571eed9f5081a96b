"""The steps that seeds 003 (table 2) and 001 (figure 8) show, of this image."""

from collections.abc import Iterator

import numpy as np

from tagmetry.detect.stages import Stages
from tagmetry.detect.stages.stages import OneMarker
from tagmetry.geometry.arrays import BoolArray, GreyPixels
from tagmetry.record.display import displayable
from tagmetry.record.drawing import Pen, draw_path
from tagmetry.record.overlay import draw_overlay
from tagmetry.record.palette import DARK, ORANGE, SKY_BLUE
from tagmetry.record.stages.closeup import enlarged
from tagmetry.record.stages.panel import Panel, shown

_GAP_PX = 10
_CELL_PX = 16


def seed_003_panels(stages: Stages) -> Iterator[Panel]:
    """Give the four pictures of its table 2."""
    yield Panel("seed003-colour", "Seed 003: colour", "The image as it came.", shown(stages.image))
    yield Panel(
        "seed003-grey",
        "Seed 003: grey",
        "One value per pixel instead of three.",
        shown(stages.grey),
    )
    yield Panel(
        "seed003-edges",
        "Seed 003: Canny edges",
        "Where the grey values change fast. tagmetry needs no edges: it asks what is dark.",
        shown(_black_on_white(stages.classic.edges)),
    )
    yield Panel(
        "seed003-contours",
        "Seed 003: contours",
        f"{len(stages.classic.contours)} contours of dark areas; tagmetry walks around "
        f"{int(stages.parted.begins.sum())} of {len(stages.parted.boxes)} areas at half scale.",
        _contours(stages),
    )


def seed_001_panels(stages: Stages) -> Iterator[Panel]:
    """Give the five steps of its figure 8; three where there is no marker."""
    yield Panel(
        "seed001-threshold",
        "Seed 001: adaptive threshold",
        "Dark is what is darker than the mean around it. Noise passes it too; tagmetry's gate "
        "follows the noise.",
        shown(_black_on_white(stages.classic.is_dark)),
    )
    yield Panel(
        "seed001-rectangles",
        "Seed 001: contours with four corners",
        f"{len(stages.classic.quads)} of {len(stages.classic.contours)} contours.",
        _quads(stages),
    )
    if stages.shown is not None:
        yield from _marker_panels(stages.shown)
    yield Panel(
        "seed001-corners",
        "Seed 001: identified, with corners",
        "Lines through the edges' pixels meet in the corners; tagmetry fits the whole picture.",
        draw_overlay(stages.image, stages.findings.detections),
    )


def _marker_panels(one: OneMarker) -> Iterator[Panel]:
    flat = one.straightened
    yield Panel(
        "seed001-straightened",
        "Seed 001: straightened and thresholded",
        "The homography undoes the perspective; Otsu's one threshold for all of it.",
        _beside(displayable(flat.grey), displayable(_white_on_black(flat.is_white))),
    )
    yield Panel(
        "seed001-code",
        "Seed 001: cells and identification",
        f"The majority in each cell, compared with the dictionary in four turns: {one.family.name} "
        f"id {one.detection.id}.",
        _grid(flat.bits),
    )


def _grid(bits: BoolArray) -> GreyPixels:
    """Return cells as squares with lines between them."""
    canvas = displayable(enlarged(_white_on_black(bits), 2 * _CELL_PX))
    side_px = len(canvas)
    for k in range(0, side_px + 1, 2 * _CELL_PX):
        for ends in ([[k, 0], [k, side_px]], [[0, k], [side_px, k]]):
            draw_path(canvas, np.array(ends, dtype=np.float64), Pen(SKY_BLUE, rim_px=0))
    return canvas


def _contours(stages: Stages) -> GreyPixels:
    canvas = shown(np.full_like(stages.grey, 255))
    times = canvas.shape[1] // stages.grey.shape[1]
    for line in stages.classic.contours:
        draw_path(canvas, (line + 0.5) * times - 0.5, Pen(DARK, rim_px=0), closed=True)
    return canvas


def _quads(stages: Stages) -> GreyPixels:
    canvas = shown((stages.grey // 2 + 96).astype(np.uint8))
    times = canvas.shape[1] // stages.grey.shape[1]
    for corners_px in stages.classic.quads:
        draw_path(canvas, (corners_px + 0.5) * times - 0.5, Pen(ORANGE, rim_px=0), closed=True)
    return canvas


def _beside(left: GreyPixels, right: GreyPixels) -> GreyPixels:
    gap = np.full((len(left), _GAP_PX, 3), DARK, dtype=np.uint8)
    return np.concatenate([left, gap, right], axis=1)


def _black_on_white(marked: BoolArray) -> GreyPixels:
    return np.where(marked, 0, 255).astype(np.uint8)


def _white_on_black(marked: BoolArray) -> GreyPixels:
    return np.where(marked, 255, 0).astype(np.uint8)

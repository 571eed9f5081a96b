"""Is the white around the black border missing? White is painted there, and read again.

Three ways to guess where a border is: a square that was turned down; the image's own edge, which
may cut the quiet zone off; and the white cells inside, where border and ground are equally dark.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import cv2
import numpy as np

from tagmetry.detect.detection import Detection
from tagmetry.detect.detector import Detector
from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence, detections_of, outside
from tagmetry.detect.doctor.groups import grouped
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.markers import MarkerFamily

_CELL_PX = 10
_MARGIN_CELLS = 2
_MOST_GUESSES = 60
_PAD_PX = 20
_LEAST_CHANCE = 1e-5
_CLOSINGS_PX = (3, 7, 15, 31, 61)


def check_quiet_zone(evidence: Evidence) -> tuple[Advice, ...]:
    """Name markers that are read once white is painted around them."""
    known = detections_of((*evidence.found, *evidence.others))
    at_edge = _advice(
        "the image's edge cuts it off", outside(_padded(evidence), known), evidence, 1
    )
    if at_edge or known:
        return at_edge
    families = _telling(evidence.families)
    guesses = list(_guesses(evidence, families))[:_MOST_GUESSES] if families else []
    painted = [d for quad in guesses for d in _painted(evidence.grey, quad, families)]
    return _advice("what lies around is too dark", painted, evidence, len(guesses))


def _advice(
    why: str, detections: Sequence[Detection], evidence: Evidence, tries: int
) -> tuple[Advice, ...]:
    return tuple(
        Advice(
            "hint" if evidence.found else "problem",
            "no quiet zone",
            f"{group}: found only when white is painted around the black border: {why}",
            "leave at least one cell of white all around, and keep all of it in the picture",
        )
        for group in grouped(detections, evidence.families)
        if group.is_sure(tries)
    )


def _padded(evidence: Evidence) -> tuple[Detection, ...]:
    """Return what is found when the image gets a white margin."""
    grey = evidence.grey
    white = int(np.percentile(grey, 95))
    pads = (_PAD_PX,) * 4
    padded = cv2.copyMakeBorder(grey, *pads, cv2.BORDER_CONSTANT, value=(white,))
    found = Detector(evidence.families).detect(np.asarray(padded, dtype=np.uint8))
    return tuple(_moved(one, -_PAD_PX) for one in found)


def _moved(detection: Detection, by_px: float) -> Detection:
    return replace(detection, corners_px=detection.corners_px + by_px)


def _telling(families: Sequence[MarkerFamily]) -> tuple[MarkerFamily, ...]:
    """Return the families of black squares of which one among many guesses is no accident."""
    black = [one for one in families if not one.layout.white_border]
    return tuple(one for one in black if one.chance_of_random_match(0) < _LEAST_CHANCE)


def _guesses(evidence: Evidence, families: Sequence[MarkerFamily]) -> Iterator[Array]:
    """Return outlines (4, 2) that may be a black border's, the larger first within each kind."""
    rejected = [one.corners_px for one in evidence.findings.rejections]
    yield from sorted(rejected, key=_area, reverse=True)[: _MOST_GUESSES // 2]
    layouts = {(one.layout.side_cells, one.layout.border_cells) for one in families}
    inner = sorted(_bright_areas(evidence.grey), key=_area, reverse=True)
    for box in inner[: _MOST_GUESSES // (2 * len(layouts))]:
        for side_cells, border_cells in sorted(layouts):
            yield from _squares_around(box, side_cells, border_cells)


def _squares_around(box: Array, side_cells: int, border_cells: int) -> Iterator[Array]:
    """Return the squares that a box of bright cells may lie in.

    The box spans all bits one way; the other way a row of bits or more may be black at either end.
    """
    data_cells = side_cells - 2 * border_cells
    origin, across, down = box[0], box[1] - box[0], box[3] - box[0]
    if np.linalg.norm(across) < np.linalg.norm(down):
        origin, across, down = box[3], -down, across
    cell_px = np.linalg.norm(across) / data_cells
    right, below = across / data_cells, down / np.linalg.norm(down) * cell_px
    missing = max(0, data_cells - round(float(np.linalg.norm(down) / cell_px)))
    for above in range(missing + 1):
        top_left = origin - border_cells * right - (border_cells + above) * below
        steps = side_cells * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
        yield top_left + steps[:, :1] * right + steps[:, 1:] * below


def _bright_areas(grey: GreyPixels) -> Iterator[Array]:
    """Return the boxes (4, 2) around bright cells that lie close together."""
    _, bright = cv2.threshold(grey, 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)
    for size_px in _CLOSINGS_PX:
        closed = cv2.morphologyEx(bright, cv2.MORPH_CLOSE, np.ones((size_px, size_px), np.uint8))
        outlines, _ = cv2.findContours(closed, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
        for outline in outlines:
            box = np.asarray(cv2.boxPoints(cv2.minAreaRect(outline)), dtype=np.float64)
            if _is_squarish(box):
                yield box


def _is_squarish(corners: Array) -> bool:
    width_px, height_px = np.linalg.norm(corners[1:3] - corners[:2], axis=1)
    shorter, longer = sorted((float(width_px), float(height_px)))
    return shorter > 8 and longer < 1.6 * shorter


def _painted(
    grey: GreyPixels, quad: Array, families: Sequence[MarkerFamily]
) -> tuple[Detection, ...]:
    """Return what is found in a square that was straightened and given a white margin."""
    cells = max(one.layout.side_cells for one in families)
    side_px, margin_px = cells * _CELL_PX, _MARGIN_CELLS * _CELL_PX
    square = np.array([[0, 0], [side_px, 0], [side_px, side_px], [0, side_px]]) + margin_px - 0.5
    H = cv2.getPerspectiveTransform(quad.astype(np.float32), square.astype(np.float32))
    patch = cv2.warpPerspective(grey, H, (side_px + 2 * margin_px,) * 2)
    inside = patch[margin_px:-margin_px, margin_px:-margin_px]
    framed = np.full(patch.shape, np.percentile(inside, 98), dtype=np.uint8)
    framed[margin_px:-margin_px, margin_px:-margin_px] = inside
    found = Detector(families).detect(framed)
    return tuple(one for one in found if one.side_px > 0.8 * side_px)


def _area(corners: Array) -> float:
    (ax, ay), (bx, by) = corners[2] - corners[0], corners[3] - corners[1]
    return float(abs(ax * by - ay * bx) / 2)

"""How an image is parted into dark and bright: at half its scale, by the middle one of its looks.

Areas and outlines are those of the same mask, found by OpenCV here, so that areas the detector
passes over without a look can be shown too.
"""

from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.detect.segment.dark import RIM_PX, columns_and_rows, dark_bits
from tagmetry.detect.segment.look import Look
from tagmetry.detect.segment.starts import starts
from tagmetry.detect.segment.tiles import TILE_PX, Tiles
from tagmetry.geometry.arrays import Array, BoolArray, GreyPixels, IntArray

_SHARE = 0.5
_LEAST_TILED_PX = 4
_DETOUR = 1.25  # an outline's length by the way around its box


@dataclass(frozen=True, eq=False)
class Parted:
    """Dark areas of an image.

    Attributes:
        scale: Of `grey` by the image, 0.5 or 1.
        grey: What was looked at, shape (h, w).
        gate: The least difference of grey values that is not noise.
        level: The grey value below which each pixel is dark, 0 where all is plain, shape (h, w).
        is_dark: Shape (h, w).
        boxes: Left, top, width, height of each dark area, pixels of `grey`, shape (n, 4).
        outlines: Pixels around each of them, shapes (m, 2).
        begins: Whether the image steps clearly where each outline begins: it is walked, (n,).
        is_likely: Which of these are large enough and without detours in their outline, (n,).
    """

    scale: float
    grey: GreyPixels
    gate: float
    level: GreyPixels
    is_dark: BoolArray
    boxes: IntArray
    outlines: tuple[Array, ...]
    begins: BoolArray
    is_likely: BoolArray


def parted(grey: GreyPixels, min_side_px: float) -> Parted:
    """Return the dark areas of an image; `min_side_px` is the least side of a marker in it."""
    scale = 0.5 if min(grey.shape) >= 4 * _LEAST_TILED_PX else 1.0
    seen = _halved(grey) if scale < 1 else grey
    tiles = Tiles.of(seen)
    gate, level = tiles.gate, tiles.levels(_SHARE, tiles.gate)
    height, width = seen.shape
    bits = dark_bits(seen, level)
    first = starts(bits, seen, tiles.near.ranges, Look().step_share, seen.size)
    rimmed = np.unpackbits(bits, axis=1, bitorder="little")
    mask = rimmed[RIM_PX : RIM_PX + height, RIM_PX : RIM_PX + width]
    boxes, outlines = _areas(mask)
    begins = _begin_at(outlines, columns_and_rows(first, bits))
    likely = begins & _are_likely(boxes, outlines, scale * min_side_px)
    per_pixel = np.kron(level, np.ones((TILE_PX, TILE_PX), np.uint8))[:height, :width]
    return Parted(scale, seen, gate, per_pixel, mask > 0, boxes, outlines, begins, likely)


def _halved(grey: GreyPixels) -> GreyPixels:
    """Return means of two by two pixels."""
    height, width = grey.shape
    whole = grey[: height // 2 * 2, : width // 2 * 2]
    small = cv2.resize(whole, (width // 2, height // 2), interpolation=cv2.INTER_AREA)
    return np.asarray(small, dtype=np.uint8)


def _areas(mask: GreyPixels) -> tuple[IntArray, tuple[Array, ...]]:
    """Return the boxes (n, 4) and the outer outlines of areas whose pixels share sides."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask, connectivity=4)
    boxes = np.asarray(stats[1:, :4], dtype=np.intp)
    label_of = np.asarray(labels, dtype=np.intp)
    outlines = [_outline(label_of, k, boxes[k - 1].tolist()) for k in range(1, count)]
    return boxes, tuple(outlines)


def _outline(labels: IntArray, label: int, box: list[int]) -> Array:
    left, top, width, height = box
    own = (labels[top : top + height, left : left + width] == label).astype(np.uint8)
    found, _ = cv2.findContours(own, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    longest = max(found, key=len).reshape(-1, 2)
    return np.asarray(longest + np.array([left, top]), dtype=np.float64)


def _begin_at(outlines: tuple[Array, ...], first: IntArray) -> BoolArray:
    """Say of each outline whether its first pixel in reading order is among those given, (n,)."""
    known = set(map(tuple, first.tolist()))
    rows = [line[np.lexsort(line.T)[0]] for line in outlines]
    return np.array([(int(x), int(y)) in known for x, y in rows], dtype=bool)


def _are_likely(boxes: IntArray, outlines: tuple[Array, ...], least_px: float) -> BoolArray:
    """Say of each area whether it is large enough and its outline makes no detours, (n,)."""
    sides, lengths = boxes[:, 2:], np.array([len(line) for line in outlines])
    large = (sides.max(axis=1, initial=0) >= least_px) & (
        sides.min(axis=1, initial=2**31) >= 0.5 * least_px
    )
    return np.asarray(large & (lengths <= _DETOUR * 2 * sides.sum(axis=1)))

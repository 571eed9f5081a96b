"""Dark or bright squares in a grey image: the candidates for markers.

Each pass thresholds the image against its neighbourhood, follows the outlines, and keeps those that
are well described by four sides. Passes differ in the neighbourhood's size, in scale (small markers
are looked for in an enlarged image) and in what counts as dark: darker than the mean, the same
thinned (which parts the squares of a board whose corners touch), or below midway between the
darkest and the brightest (which follows the true edges of a blurred board on bright paper).

OpenCV's primitives do the work; `quads` is the seam where an engine of our own will follow.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from tagmetry.geometry.arrays import AnyPixels, Array, BoolArray, GreyPixels

_DARKER_BY = 6  # grey values below the neighbourhood's mean
_CLEAR = 20  # grey values between the darkest and the brightest around
_STRAIGHT = 0.04  # how far an outline may stray from its polygon, as a share of its length
_LEAST_ANGLE_SINE = 0.2
_MAX_OUTLINES = 3000  # per pass, the longest first: noise must not stall a frame


@dataclass(frozen=True)
class Pass:
    """One way of looking for squares.

    Attributes:
        scale: The image is resized by this factor first.
        window_px: Side of the neighbourhood, pixels of the resized image.
        midway: Dark is what lies below midway between the neighbourhood's darkest and brightest,
            instead of what is darker than its mean.
        thinned: Dark areas are thinned by a pixel before outlines are followed.
    """

    scale: float
    window_px: int
    midway: bool = False
    thinned: bool = False


@dataclass(frozen=True, eq=False)
class Squares:
    """Outlines with four sides; the same square again where several passes saw it.

    Attributes:
        corners_px: Clockwise as seen, pixel centres at integers, shape (n, 4, 2).
        is_bright: Whether the inside is brighter than the outside, shape (n,).
    """

    corners_px: Array
    is_bright: BoolArray


def passes(width_px: int, height_px: int, min_side_px: float) -> tuple[Pass, ...]:
    """Return the passes for an image in which markers have at least a certain side.

    Neighbourhoods must be wider than a marker's border, and be small enough for uneven light.
    """
    longer_px = max(width_px, height_px)
    wide_px = _odd(longer_px / 16)
    plain = [Pass(1.0, size) for size in sorted({9, 21, wide_px})]
    thinned = [Pass(1.0, 21, thinned=True)]
    enlarged = [Pass(2.0, 15), Pass(2.0, 31, midway=True), Pass(2.0, 31, midway=True, thinned=True)]
    enlarged = enlarged if min_side_px < 24 else []
    return (*plain, *thinned, *enlarged)


def quads(grey: GreyPixels, min_side_px: float, *, bright: bool) -> Squares:
    """Return the outlines with four sides.

    Args:
        grey: 8-bit image.
        min_side_px: Sides shorter than this are passed over.
        bright: Bright squares on dark as well; the inside of a wide black border is one, too.
    """
    height_px, width_px = grey.shape
    found = [
        _quads_of_pass(grey, one, min_side_px, bright)
        for one in passes(width_px, height_px, min_side_px)
    ]
    return Squares(
        np.concatenate([squares.corners_px for squares in found]),
        np.concatenate([squares.is_bright for squares in found]),
    )


def _quads_of_pass(grey: GreyPixels, one: Pass, min_side_px: float, bright: bool) -> Squares:
    scaled = grey
    if one.scale != 1.0:
        scaled = np.asarray(
            cv2.resize(grey, None, fx=one.scale, fy=one.scale, interpolation=cv2.INTER_CUBIC),
            dtype=np.uint8,
        )
    dark = _dark(scaled, one)
    outset_px = 1.5 if one.thinned else 0.5
    outlines, _ = cv2.findContours(dark, cv2.RETR_LIST, cv2.CHAIN_APPROX_NONE)
    found = list(_four_sided(outlines, one.scale * min_side_px, outset_px, bright))
    corners = np.array([corners for corners, _ in found]).reshape(-1, 4, 2)
    is_bright = np.array([is_hole for _, is_hole in found], dtype=bool)
    return Squares((corners + 0.5) / one.scale - 0.5, is_bright)


def _dark(grey: GreyPixels, one: Pass) -> AnyPixels:
    """Return what is dark in a pass as 255, the rest as 0."""
    dark = (_below_midway if one.midway else _below_mean)(grey, one.window_px)
    return cv2.erode(dark, np.ones((3, 3), np.uint8)) if one.thinned else dark


def _below_mean(grey: GreyPixels, window_px: int) -> AnyPixels:
    method, kind = cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV
    return cv2.adaptiveThreshold(grey, 255, method, kind, window_px, _DARKER_BY)


def _below_midway(grey: GreyPixels, window_px: int) -> AnyPixels:
    window = np.ones((window_px, window_px), np.uint8)
    darkest, brightest = cv2.erode(grey, window), cv2.dilate(grey, window)
    midway = cv2.addWeighted(darkest, 0.5, brightest, 0.5, 0)
    _, clear = cv2.threshold(cv2.subtract(brightest, darkest), _CLEAR, 255, cv2.THRESH_BINARY)
    return cv2.bitwise_and(cv2.compare(grey, midway, cv2.CMP_LT), clear)


def _four_sided(
    outlines: Sequence[AnyPixels], min_side_px: float, outset_px: float, bright: bool
) -> Iterator[tuple[Array, bool]]:
    """Give the corners of the outlines with four sides, and whether they surround a bright area."""
    long_enough = [outline for outline in outlines if len(outline) >= 3 * min_side_px]
    long_enough.sort(key=len, reverse=True)
    for outline in long_enough[:_MAX_OUTLINES]:
        is_hole = _is_hole(outline)
        if is_hole and not bright:
            continue
        polygon = cv2.approxPolyDP(outline, _STRAIGHT * len(outline), closed=True)
        if len(polygon) != 4 or not cv2.isContourConvex(polygon):
            continue
        starts = _indices(outline[:, 0], polygon[:, 0])
        signed_px = -outset_px if is_hole else outset_px
        corners = _fitted(outline[:, 0].astype(np.float64), starts, signed_px)
        if corners is not None and _is_wide(corners, min_side_px):
            yield corners, is_hole


def _indices(outline: AnyPixels, polygon: AnyPixels) -> list[int]:
    """Return where on the outline the polygon's corners are, in the outline's order."""
    return sorted(int(np.flatnonzero((outline == corner).all(axis=1))[0]) for corner in polygon)


def _fitted(outline: Array, starts: list[int], outset_px: float) -> Array | None:
    """Return the corners of four lines fitted to the outline, clockwise, set outward.

    The outline runs through the centres of dark pixels; the edge is half a pixel farther out for a
    dark square, and farther in for a bright one (its outline is the dark rim around it; outset_px
    is then negative, and the outline runs clockwise instead of counter-clockwise).
    """
    pieces = np.split(np.roll(outline, -starts[0], axis=0), np.array(starts[1:]) - starts[0])
    if min(len(piece) for piece in pieces) < 4:
        return None
    lines = np.array([_line(piece) for piece in pieces])
    centre = np.mean([piece.mean(axis=0) for piece in pieces], axis=0)
    outward = np.sign(np.einsum("ij,ij->i", lines[:, :2], lines[:, 2:] - centre))
    points = lines[:, 2:] + (outset_px * outward)[:, None] * lines[:, :2]
    corners = _crossings(lines[:, :2], points)
    if corners is None:
        return None
    return corners if outset_px < 0 else corners[::-1]


def _line(points: Array) -> Array:
    """Return (normal, point) of the least-squares line, leaving out the ends near corners."""
    trim = len(points) // 8
    middle = points[trim : len(points) - trim]
    centre = middle.mean(axis=0)
    dx, dy = (middle - centre).T
    angle = 0.5 * np.arctan2(2 * (dx @ dy), dx @ dx - dy @ dy)
    return np.array([-np.sin(angle), np.cos(angle), *centre])


def _crossings(normals: Array, points: Array) -> Array | None:
    """Return where each line meets the one before it, shape (4, 2)."""
    before = np.roll(normals, 1, axis=0)
    matrices = np.stack([before, normals], axis=1)
    offsets = (normals * points).sum(axis=1)
    if (np.abs(np.linalg.det(matrices)) < _LEAST_ANGLE_SINE).any():
        return None
    right = np.stack([np.roll(offsets, 1), offsets], axis=1)
    return np.asarray(np.linalg.solve(matrices, right[..., None])[..., 0])


def _is_wide(corners: Array, min_side_px: float) -> bool:
    sides = np.roll(corners, -1, axis=0) - corners
    lengths = np.linalg.norm(sides, axis=1)
    following = np.roll(sides, -1, axis=0)
    turns = sides[:, 0] * following[:, 1] - sides[:, 1] * following[:, 0]
    return bool(lengths.min() >= min_side_px and (turns > 0).all())


def _is_hole(outline: AnyPixels) -> bool:
    """OpenCV runs around dark areas counter-clockwise as seen, around holes in them clockwise."""
    return bool(cv2.contourArea(outline, oriented=True) > 0)


def _odd(size: float) -> int:
    return max(3, 2 * round(size / 2) + 1)

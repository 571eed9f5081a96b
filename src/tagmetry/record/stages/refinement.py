"""Where a marker's corners are, and what the fit leaves over."""

from collections.abc import Iterator

import numpy as np

from tagmetry.detect.stages import Stages
from tagmetry.detect.stages.redrawn import Redrawn
from tagmetry.detect.stages.stages import OneMarker
from tagmetry.geometry import Array
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.record.display import displayable
from tagmetry.record.drawing import Pen, draw_path
from tagmetry.record.ellipses import ellipse
from tagmetry.record.palette import DARK, ORANGE, PURPLE, SKY_BLUE
from tagmetry.record.stages.closeup import Closeup, enlarged
from tagmetry.record.stages.panel import Panel

_HALF_PX = 4.0  # how much of the image is shown around a corner
_TILE_PX = 315
_GAP_PX = 10
_SIGMAS = 3.0
_ELLIPSE_SHARE = 0.3  # of the half width of a tile, that the largest ellipse takes
_RESIDUAL_SIGMAS = 6.0  # from black to white


def refinement_panels(stages: Stages) -> Iterator[Panel]:
    """Give the pictures of the refined corners and of the fit's residual."""
    if stages.shown is not None:
        yield _corners(stages.grey, stages.shown)
        yield _residual(stages.shown)


def _corners(grey: GreyPixels, one: OneMarker) -> Panel:
    found = one.detection
    times = _magnification(found.corners_cov_px2)
    tiles = [_corner(grey, one, k, times) for k in range(4)]
    moved = np.linalg.norm(found.corners_px - one.first_px, axis=1)
    deviation = float(np.sqrt(np.trace(found.corners_cov_px2) / 8))
    return Panel(
        "corners",
        "Refined corners",
        f"Orange: the outline's square. Blue: after the fit to the raw pixels, moved by up to "
        f"{moved.max():.2f} px. Purple: 3 standard deviations, {times:g} times enlarged; one is "
        f"{deviation:.4f} px.",
        _two_by_two(tiles),
    )


def _magnification(covariance_px2: Array) -> float:
    """Return a round factor that makes the ellipses easy to see."""
    largest_px = _SIGMAS * float(np.sqrt(np.diag(covariance_px2).max()))
    wanted = _ELLIPSE_SHARE * _HALF_PX / max(largest_px, 1e-9)
    power = 10 ** np.floor(np.log10(max(wanted, 1.0)))
    return float(power * max(step for step in (1, 2, 5) if step * power <= max(wanted, 1.0)))


def _corner(grey: GreyPixels, one: OneMarker, k: int, times: float) -> GreyPixels:
    place = one.detection.corners_px[k]
    view = Closeup.around(grey, place - _HALF_PX, place + _HALF_PX, _TILE_PX)
    draw_path(view.canvas, view.at(one.first_px), Pen(ORANGE, 2), closed=True)
    draw_path(view.canvas, view.at(one.detection.corners_px), Pen(SKY_BLUE, 2), closed=True)
    own = one.detection.corners_cov_px2[2 * k : 2 * k + 2, 2 * k : 2 * k + 2]
    around = place + _SIGMAS * times * ellipse(own)
    draw_path(view.canvas, view.at(around), Pen(PURPLE, 2), closed=True)
    return view.canvas


def _two_by_two(tiles: list[GreyPixels]) -> GreyPixels:
    """Return the corners as they stand on the marker: 0 1 above 3 2."""
    height, width = np.max([tile.shape[:2] for tile in tiles], axis=0)
    canvas = np.full((2 * height + _GAP_PX, 2 * width + _GAP_PX, 3), DARK, dtype=np.uint8)
    places = (
        (0, 0),
        (0, width + _GAP_PX),
        (height + _GAP_PX, width + _GAP_PX),
        (height + _GAP_PX, 0),
    )
    for tile, (top, left) in zip(tiles, places, strict=True):
        canvas[top : top + tile.shape[0], left : left + tile.shape[1]] = tile
    return canvas


def _residual(one: OneMarker) -> Panel:
    drawn = one.redrawn
    left = drawn.residual[np.isfinite(drawn.residual)]
    spread = max(1.4826 * float(np.median(np.abs(left))), 0.5)
    parts = [
        _as_pixels(drawn.seen),
        _as_pixels(drawn.drawn),
        _as_pixels(128 + drawn.residual * (128 / (_RESIDUAL_SIGMAS * spread))),
    ]
    return Panel(
        "residual",
        "What the fit leaves over",
        "Seen, drawn from the refined corners, and the difference: grey is none, black and white "
        f"are {_RESIDUAL_SIGMAS * spread:.0f} grey values. Corners a tenth of a pixel off, or "
        f"a lens that is not known, would show as lines. Blur {drawn.blur_px:.2f} px, response "
        f"exponent {drawn.exponent:.2f}, noise {spread:.1f} grey values.",
        _side_by_side(parts, drawn),
    )


def _as_pixels(values: Array) -> GreyPixels:
    return np.asarray(np.clip(np.nan_to_num(values, nan=128.0), 0, 255), dtype=np.uint8)


def _side_by_side(parts: list[GreyPixels], drawn: Redrawn) -> GreyPixels:
    times = max(1, _TILE_PX // drawn.seen.shape[1])
    gap = np.full((times * drawn.seen.shape[0], _GAP_PX), DARK[0], dtype=np.uint8)
    first, second, third = (enlarged(part, times) for part in parts)
    return displayable(np.concatenate([first, gap, second, gap, third], axis=1))

"""What pictures show of a board, kept small: corners, the pixels around them, a thumbnail."""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np

from tagmetry.calibrate.result import Calibration
from tagmetry.calibrate.second_look import look_again
from tagmetry.calibrate.targets import Patches, explain_board
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.markers import Board

_THUMBNAIL_PX = 240
_LOOKED_AT = 6  # pictures that the doctor looks at
_MOST_BYTES = 500_000_000  # of patches; views of a very long video keep their first corners


@dataclass(frozen=True, eq=False)
class Sighting:
    """What one picture gave.

    Attributes:
        result: The board's corners, or why there are none.
        thumbnail: The picture, small and grey; empty where it could not be read.
        patches: The pixels around the board's corners, to look at them again.
        pixels: The picture itself, where the doctor may want to look at it.
    """

    result: BoardView | RejectedView
    thumbnail: GreyPixels
    patches: Patches | None = None
    pixels: AnyPixels | None = None


def sightings(images: Iterable[Image], board: Board) -> Iterator[Sighting]:
    """Give what each picture shows; one that cannot be read counts as showing nothing.

    Args:
        images: Of a finite source.
        board: What to look for.
    """
    following = iter(images)
    looked_at = kept_bytes = 0
    while True:
        try:
            image = next(following)
        except StopIteration:
            return
        except InputError as error:
            yield Sighting(RejectedView("", str(error)), np.zeros((0, 0), np.uint8))
            continue
        seen = look(image, board)
        looked_at += 1
        kept_bytes += seen.patches.pixels.nbytes if seen.patches is not None else 0
        yield replace(
            seen,
            pixels=seen.pixels if looked_at <= _LOOKED_AT else None,
            patches=seen.patches if kept_bytes <= _MOST_BYTES else None,
        )


def look(image: Image, board: Board) -> Sighting:
    """Return what a picture shows of a board."""
    place = image.source if image.time_kind == "none" else f"{image.source} [{image.sequence}]"
    found = explain_board(image.pixels, board, source=place)
    return Sighting(found.result, thumbnail(image.pixels), found.patches, image.pixels)


def looked_again(
    seen: Sequence[Sighting], calibration: Calibration, board: Board
) -> tuple[Sighting, ...]:
    """Return a calibration's views as pictures give them once its camera is known.

    Args:
        seen: What the pictures gave at first, at least those of the calibration's views.
        calibration: From these.
        board: What was looked for.
    """
    of_view = {id(one.result): one for one in seen}
    pairs = zip(calibration.views, look_again(calibration, seen, board), strict=True)
    return tuple(replace(of_view[id(first)], result=view) for first, view in pairs)


def thumbnail(pixels: AnyPixels) -> GreyPixels:
    """Return a picture small and grey, 8 bits."""
    share = min(1.0, _THUMBNAIL_PX / max(pixels.shape[:2]))
    size = (max(1, round(pixels.shape[1] * share)), max(1, round(pixels.shape[0] * share)))
    small = np.asarray(cv2.resize(pixels, size, interpolation=cv2.INTER_AREA))
    if small.dtype == np.uint16:
        small = (small // 257).astype(np.uint8)
    grey = cv2.cvtColor(small, cv2.COLOR_BGR2GRAY) if small.ndim == 3 else small
    return np.asarray(grey, dtype=np.uint8)

"""Was the board printed at its true size? A ruler tells; pictures tell only part of it.

A board that is printed larger or smaller looks like the right one nearer or farther: focal length
and distortion come out the same, and every distance is wrong by the scale. No picture shows that.
A board that is printed longer one way than the other does show, once it was seen turned in its
plane: a turn swaps its two directions, but not those of the camera's pixels.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from tagmetry.calibrate.doctor.advice import BoardAdvice
from tagmetry.calibrate.result import Calibration
from tagmetry.errors import InputError
from tagmetry.markers import AprilGrid, Board, CharucoBoard, Chessboard, CircleGrid, GridBoard

SPANS = ("width", "height", "square", "marker")
"""What a ruler may measure: the whole pattern without margins, one square, one marker's side."""

_SAME = 0.002  # a careful ruler over 150 mm
_SQUARE_PIXELS = 0.003  # cameras' pixels are square to better than this


def check_measured(board: Board, measured_m: Mapping[str, float]) -> tuple[BoardAdvice, ...]:
    """Return how the printed board differs from the one asked for, by a ruler.

    Args:
        board: The board asked for.
        measured_m: Lengths by their names, see `SPANS`.

    Raises:
        InputError: A name is unknown, or the board has no such length.
    """
    scales = {name: length / _span_m(board, name) for name, length in measured_m.items()}
    if {"width", "height"} <= scales.keys():
        ratio = scales["width"] / scales["height"]
        if abs(ratio - 1) > _SAME:
            return (_stretched(ratio),)
    off = {name: scale for name, scale in scales.items() if abs(scale - 1) > _SAME}
    if not off:
        return ()
    if len(scales) > 1 and np.ptp(list(scales.values())) > 2 * _SAME:
        return (_in_part(scales),)
    return (_scaled(board, off, measured_m),)


def check_print_aspect(calibration: Calibration) -> tuple[BoardAdvice, ...]:
    """Return that pixels or print are longer one way than the other, where the camera says so."""
    fx, fy = calibration.camera.focal_px
    covariance = calibration.camera.covariance
    if covariance is None:
        return ()
    to_ratio = np.array([1 / fy, -fx / fy**2])
    variance = float(to_ratio @ covariance[:2, :2] @ to_ratio)
    sd = np.sqrt(max(variance, 0.0))  # where the aspect was held, rounding may go below
    if abs(fx / fy - 1) < max(_SQUARE_PIXELS, 4 * sd):
        return ()
    return (
        BoardAdvice(
            "hint",
            "not square",
            "fx = fy, as of square pixels",
            f"fx / fy = {fx / fy:.4f} ± {sd:.4f}",
            "either the camera's pixels are not square, or the board is printed longer one way: "
            "measure its width and height with a ruler and give both",
        ),
    )


def _span_m(board: Board, name: str) -> float:
    if name == "width":
        return board.width_m
    if name == "height":
        return board.height_m
    match name, board:
        case "square", Chessboard() | CharucoBoard():
            return board.square_m
        case "marker", CharucoBoard() | GridBoard() | AprilGrid():
            return board.size_m
    raise InputError(
        f"expected a measured length of width, height, square (of boards with squares) or marker "
        f"(of boards with markers), found {name[:40]!r} for a {type(board).__name__}"
    )


def _scaled(
    board: Board, scales: Mapping[str, float], measured_m: Mapping[str, float]
) -> BoardAdvice:
    scale = float(np.mean(list(scales.values())))
    named = ", ".join(f"{name} of {_span_m(board, name) * 1e3:.1f} mm" for name in scales)
    seen = ", ".join(f"{measured_m[name] * 1e3:.1f} mm" for name in scales)
    return BoardAdvice(
        "problem",
        "printed at another scale",
        named,
        f"{seen}: {scale:.1%} of it",
        f"the camera's numbers stay right, but every distance would be wrong by {scale - 1:+.1%}",
        _resized(board, scale),
    )


def _stretched(ratio: float) -> BoardAdvice:
    return BoardAdvice(
        "problem",
        "printed longer one way than the other",
        "one scale in width and height",
        f"a width {ratio - 1:+.1%} too long for the height",
        "print again, without fitting to the page; no camera can be had from such a board",
    )


def _in_part(scales: Mapping[str, float]) -> BoardAdvice:
    shares = ", ".join(f"{name} {scale:.1%}" for name, scale in scales.items())
    return BoardAdvice(
        "problem",
        "lengths that do not go together",
        "all measured lengths at one scale",
        shares,
        "the board asked for is another one: check its numbers of columns and rows and its sizes",
    )


def _resized(board: Board, scale: float) -> Board:
    """Return a board of another size, lengths to a hundredth of a millimetre."""

    def new(length_m: float) -> float:
        return round(length_m * scale, 5)

    match board:
        case Chessboard():
            return replace(board, square_m=new(board.square_m))
        case CharucoBoard():
            return replace(board, square_m=new(board.square_m), size_m=new(board.size_m))
        case GridBoard():
            return replace(board, size_m=new(board.size_m), gap_m=new(board.gap_m))
        case AprilGrid():
            return replace(board, size_m=new(board.size_m))
        case CircleGrid():
            return replace(board, pitch_m=new(board.pitch_m), diameter_m=new(board.diameter_m))
    raise InputError(f"a board of type {type(board).__name__} has no scale")

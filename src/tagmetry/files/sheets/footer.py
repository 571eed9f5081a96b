"""The foot of every page: what it is, a ruler to check the printer, and how to print it."""

from dataclasses import dataclass
from textwrap import wrap

from tagmetry.errors import InputError
from tagmetry.files.lengths import format_mm
from tagmetry.files.sheets.page import Box, Cells, Shape, Text, bar, text_width_m

_FONT_M = 0.0030
_LINE_M = 0.0040
_STEP_M = 0.010
_LONGEST_STEPS = 10
_HAIR_M = 0.0002
_TICK_M = 0.0025
_LONG_TICK_M = 0.0040
_RULER_ROOM_M = _LONG_TICK_M + 0.0010
_GAP_M = 0.0030  # between the page's content and its foot


@dataclass(frozen=True)
class Footer:
    """The foot of a page, and the room that it leaves above."""

    shapes: tuple[Shape, ...]
    room: Box


def footer(printable: Box, caption: str) -> Footer:
    """Return the foot of a page.

    Args:
        printable: The page within its margins.
        caption: What the page shows.

    Raises:
        InputError: The page is too small for a ruler.
    """
    steps = min(_LONGEST_STEPS, int(printable.width_m / _STEP_M + 1e-9))
    above, below = _wrapped(caption, printable.width_m), _wrapped(_note(steps), printable.width_m)
    height_m = (len(above) + len(below)) * _LINE_M + _RULER_ROOM_M
    top_m = printable.bottom_m - height_m
    if steps < 1 or top_m - _GAP_M <= printable.y_m:
        raise InputError(
            f"the page leaves {format_mm(printable.width_m)} x {format_mm(printable.height_m)} "
            "within its margins, too little for the ruler and the caption; take a larger paper"
        )
    ruler_m = top_m + len(above) * _LINE_M
    shapes: tuple[Shape, ...] = (
        *_lines(above, printable.x_m, top_m),
        *_ruler(printable.x_m, ruler_m, steps),
        *_lines(below, printable.x_m, ruler_m + _RULER_ROOM_M),
    )
    height_left_m = top_m - _GAP_M - printable.y_m
    return Footer(shapes, Box(printable.x_m, printable.y_m, printable.width_m, height_left_m))


def _note(steps: int) -> str:
    return (
        f"Measure this: must be exactly {steps * _STEP_M * 1000:.1f} mm. "
        "Print at 100 %, do not fit to page."
    )


def _ruler(x_m: float, y_m: float, steps: int) -> list[Cells]:
    """Return the ruler; its length is from the outer side of its first tick to that of its last."""
    length_m = steps * _STEP_M
    base = bar(x_m, y_m + _LONG_TICK_M - _HAIR_M, length_m, _HAIR_M)
    return [base, *(_tick(x_m, y_m, step, steps) for step in range(steps + 1))]


def _tick(x_m: float, y_m: float, step: int, steps: int) -> Cells:
    is_long = step in {0, steps} or step % 5 == 0
    height_m = _LONG_TICK_M if is_long else _TICK_M
    inward_m = _HAIR_M * step / steps  # the first tick lies right of its place, the last one left
    left_m = x_m + step * _STEP_M - inward_m
    return bar(left_m, y_m + _LONG_TICK_M - height_m, _HAIR_M, height_m)


def _lines(lines: list[str], x_m: float, top_m: float) -> list[Text]:
    return [
        Text(x_m, top_m + row * _LINE_M + 0.75 * _LINE_M, _FONT_M, line)
        for row, line in enumerate(lines)
    ]


def _wrapped(text: str, width_m: float) -> list[str]:
    """Break a text between words so that its lines fit."""
    lines = [""]
    for word in _words(text, width_m):
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and text_width_m(longer, _FONT_M) > width_m:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def _words(text: str, width_m: float) -> list[str]:
    """Split a text into words, and words that are wider than a line into pieces."""
    words: list[str] = []
    for word in text.split():
        wide = text_width_m(word, _FONT_M) > width_m
        words += wrap(word, _letters_in(width_m)) if wide else [word]
    return words


def _letters_in(width_m: float) -> int:
    return max(1, int(width_m / text_width_m("W", _FONT_M)))

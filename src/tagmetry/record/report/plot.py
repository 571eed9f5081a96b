"""A blank figure with axes, and a figure as SVG or PNG; by Matplotlib, which is optional."""

import io
from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

from tagmetry.errors import MissingExtraError
from tagmetry.record.palette import ORANGE, SKY_BLUE, VERMILLION, Color

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Normalize
    from matplotlib.figure import Figure

_STYLE: dict[Any, object] = {
    "font.size": 10,
    "font.family": "DejaVu Sans",
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#d9d9d9",
    "grid.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "svg.hashsalt": "tagmetry",
}


def _hex(color: Color) -> str:
    blue, green, red = color
    return f"#{red:02x}{green:02x}{blue:02x}"


BLUE, RED, GOLD = "#0072b2", _hex(VERMILLION), _hex(ORANGE)
LIGHT = _hex(SKY_BLUE)


def blank(width_in: float = 7.0, height_in: float = 4.6) -> "tuple[Figure, Axes]":
    """Return a figure with axes.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    with _styled():
        from matplotlib.figure import Figure

        figure = Figure(figsize=(width_in, height_in), layout="constrained", facecolor="white")
        return figure, figure.subplots()


def image_axes(axes: "Axes", size_px: tuple[int, int]) -> None:
    """Make axes those of an image: x right, y down, in pixels, all of it shown."""
    axes.set_xlim(-0.5, size_px[0] - 0.5)
    axes.set_ylim(size_px[1] - 0.5, -0.5)
    axes.set_aspect("equal")
    axes.set_xlabel("x, px")
    axes.set_ylabel("y, px")


def log_colors(levels: Sequence[float]) -> "Normalize":
    """Return how colours follow levels that rise by factors."""
    from matplotlib.colors import LogNorm

    return LogNorm(levels[0], levels[-1])


def plain_ticks(axes: "Axes") -> None:
    """Write a logarithmic axis' numbers as people do: 0.5, 1, 2, 50."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FormatStrFormatter("%g"))
        axis.set_minor_formatter(NullFormatter())


def svg(figure: "Figure") -> bytes:
    """Return a figure as SVG, the same bytes on every run."""
    content = io.BytesIO()
    with _styled():
        figure.savefig(content, format="svg", metadata={"Date": None, "Creator": None})
    return content.getvalue()


def png(figure: "Figure") -> bytes:
    """Return a figure as PNG, 150 dots per inch."""
    content = io.BytesIO()
    with _styled():
        figure.savefig(content, format="png", dpi=150, metadata={"Software": None})
    return content.getvalue()


def _styled() -> AbstractContextManager[None]:
    """Return a block in which Matplotlib draws in this style.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    try:
        from matplotlib import rc_context
    except ModuleNotFoundError as error:
        raise MissingExtraError("figures", "report") from error
    return rc_context(_STYLE)

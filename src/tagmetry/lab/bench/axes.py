"""How the axes of the laboratory's pictures are written."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis


def dress(axes: "Axes", title: str, abscissa: str, ordinate: str) -> None:
    """Write what axes show."""
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(abscissa)
    axes.set_ylabel(ordinate)
    axes.grid(visible=True, which="both", alpha=0.2)


def both_logarithmic(axes: "Axes") -> None:
    """Make both axes logarithmic."""
    axes.set_yscale("log")
    plain_numbers(axes.yaxis)
    x_logarithmic(axes)


def x_logarithmic(axes: "Axes") -> None:
    """Make the horizontal axis logarithmic."""
    axes.set_xscale("log")
    plain_numbers(axes.xaxis)


def plain_numbers(axis: "Axis", steps: Sequence[float] = (1.0, 2.0, 5.0)) -> None:
    """Write a logarithmic axis' numbers as people do: 0.5, 1, 2, 50."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=steps))
    axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_formatter(NullFormatter())

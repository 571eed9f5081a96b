"""A figure of a report, with its title and a text for those who do not see it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class ReportFigure:
    """A figure.

    Attributes:
        name: Of its file, without the ending.
        title: For people.
        told: What it shows, with its numbers, for those who do not see it.
        draw: Draws it.
    """

    name: str
    title: str
    told: str
    draw: "Callable[[], Figure]"

"""What seed 000 says of its figures 9 to 15 in words."""

from functools import lru_cache
from importlib.resources import files
from typing import Literal

from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import parse_table


class FigureStatement(FileModel):
    """What the text says of a figure.

    Attributes:
        figure: Which.
        quantity: What it is about.
        at: The number, in the unit of the quantity's name.
        words: The text.
    """

    figure: str
    quantity: Literal["range_m", "depth_percent", "turn_deg", "time_s"]
    at: float
    words: str


class Seed000(FileModel):
    """All that is compared with.

    Attributes:
        source: The paper.
        figures: Its statements.
        most_scan_images: Images until a marker is found, at most.
        remarks: Where it slips, and how it is taken here.
    """

    source: str
    figures: list[FigureStatement]
    most_scan_images: int
    remarks: list[str]

    def said(self, figure: str, quantity: str) -> FigureStatement:
        """Return what is said of a figure."""
        return next(s for s in self.figures if (s.figure, s.quantity) == (figure, quantity))


@lru_cache
def seed000() -> Seed000:
    """Return what the paper says."""
    text = (files("tagmetry.lab.published") / "seed000.yaml").read_text("utf-8")
    return checked(Seed000, parse_table(text))

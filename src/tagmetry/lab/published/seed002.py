"""What seed 002 says of its figures in words, and its tables 1 and 2."""

from functools import lru_cache
from importlib.resources import files
from typing import Literal

from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import parse_table


class Statement(FileModel):
    """What the text says of an error.

    Attributes:
        figures: Which figures it is about.
        layout: Which markers.
        quantity: Which error.
        from_m: Nearest distance that it speaks of.
        to_m: Farthest.
        at_most: The error, metres or degrees, as printed.
        words: The text.
    """

    figures: list[int]
    layout: str
    quantity: Literal["radial_m", "xy_m", "angle_deg"]
    from_m: float
    to_m: float
    at_most: float
    words: str


class Zones(FileModel):
    """Tables 1 and 2: nine zones of the picture, row by row from the top left."""

    radial_cm: list[float]
    xy_mm: list[float]
    z_cm: list[float]


class Seed002(FileModel):
    """All that is compared with.

    Attributes:
        source: The paper.
        statements: About figures 4 to 25.
        zones: Tables 1 and 2.
        remarks: Where it slips, and how it is taken here.
    """

    source: str
    statements: list[Statement]
    zones: Zones
    remarks: list[str]


@lru_cache
def seed002() -> Seed002:
    """Return what the paper says."""
    text = (files("tagmetry.lab.published") / "seed002.yaml").read_text("utf-8")
    return checked(Seed002, parse_table(text))

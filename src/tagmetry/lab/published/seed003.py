"""What seed 003 prints: its camera (tables 3 and 4), its error, and tables 7 to 15 with figures."""

from functools import lru_cache
from importlib.resources import files
from typing import Literal

from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import parse_table

Axis = Literal["x", "y", "z"]


class PositionTable(FileModel):
    """One of tables 7 to 15: positions along an axis at a distance.

    Attributes:
        table: Its number.
        axis: Of the camera.
        distance_cm: From the camera; for z, of the nearest position.
        figures: Numbers of the figures of its errors and of its regression.
        mean: Absolute error cm, relative error %, accuracy %, as printed.
        regression: Constant and slope as printed.
        rows: Computed cm, actual cm, absolute error cm, relative error %, as printed.
    """

    table: int
    axis: Axis
    distance_cm: int
    figures: list[int] | None
    mean: list[float]
    regression: list[float] | None
    rows: list[list[float]]


class PrintedCalibration(FileModel):
    """The camera matrix and distortion of tables 3 and 4, and the error."""

    views: int
    error_px: float
    focal_px: list[float]
    center_px: list[float]
    coefficients: list[float]


class Seed003(FileModel):
    """All that is compared with.

    Attributes:
        source: The paper.
        calibration: Tables 3 and 4, and the error.
        positions: Tables 7 to 15.
        remarks: Where its figures disagree with each other, and how they are taken here.
    """

    source: str
    calibration: PrintedCalibration
    positions: list[PositionTable]
    remarks: list[str]


@lru_cache
def seed003() -> Seed003:
    """Return what the paper prints."""
    text = (files("tagmetry.lab.published") / "seed003.yaml").read_text("utf-8")
    return checked(Seed003, parse_table(text))

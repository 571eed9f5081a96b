"""What seed 001 prints: its camera, its error map, its slider and its images per second."""

from functools import lru_cache
from importlib.resources import files

from tagmetry.files.checked import FileModel, checked
from tagmetry.files.tables import parse_table


class PrintedCamera(FileModel):
    """Equation 8.

    Attributes:
        size_px: Width and height.
        focal_px: Both focal lengths.
        center_px: As printed.
        coefficients: k1, k2, p1, p2, k3.
        deviations: What is printed after each of them.
    """

    size_px: list[int]
    focal_px: list[float]
    center_px: list[float]
    coefficients: list[float]
    deviations: list[float]


class PrintedMap(FileModel):
    """Figure 9: radial errors over a grid of markers."""

    markers: int
    step_m: float
    corner_m: float
    center_m: float


class PrintedSlider(FileModel):
    """Figures 11 and 12: a marker that is moved and turned."""

    length_m: float
    turns_rad: float
    position_m: float
    angle_rad: float


class PrintedRate(FileModel):
    """A point of figure 10."""

    robots: int
    per_s: float
    words: str


class PrintedFollowing(FileModel):
    """Figures 13 and 14: a robot that follows another."""

    gap_m: float
    worst_m: float
    mean_m: float
    slip_s: float
    remarks: list[str]


class PrintedUncertainty(FileModel):
    """What the text concludes."""

    x_m: float
    y_m: float
    angle_rad: float


class Seed001(FileModel):
    """All that is compared with.

    Attributes:
        source: The paper.
        camera: Equation 8.
        error_map: Figure 9.
        slider: Figures 11 and 12.
        rates: Figure 10.
        following: Figures 13 and 14.
        uncertainty: Of x, y and the orientation.
        remarks: Where it slips, and how it is taken here.
    """

    source: str
    camera: PrintedCamera
    error_map: PrintedMap
    slider: PrintedSlider
    rates: list[PrintedRate]
    following: PrintedFollowing
    uncertainty: PrintedUncertainty
    remarks: list[str]


@lru_cache
def seed001() -> Seed001:
    """Return what the paper says."""
    text = (files("tagmetry.lab.published") / "seed001.yaml").read_text("utf-8")
    return checked(Seed001, parse_table(text))

"""Which lens model a calibration chose, of which candidates, and why."""

from dataclasses import dataclass
from typing import Literal, get_args

LensName = Literal[
    "none",
    "brown1",
    "brown2",
    "brown4",
    "brown5",
    "brown8",
    "brown12",
    "brown14",
    "fisheye",
]
"""A pinhole; OpenCV's coefficients k1 (brown1), k1 k2 (brown2), the first 4 to 14; the fisheye."""

LensModel = LensName | Literal["auto"]

LENS_NAMES: tuple[LensName, ...] = get_args(LensName)


@dataclass(frozen=True)
class ModelRow:
    """How one candidate did.

    Attributes:
        name: The model.
        parameters: How many numbers of the camera were free.
        rms_px: Error on the corners it was fitted to, weighted by what they tell; falls with every
            parameter that is added.
        hold_out_px: The same on left-out views (their own pose fitted); infinite where the
            model cannot be solved without them.
        bic: Bayesian information criterion; only differences mean something, lower is better.
        monotonic_share: Share of the image, 0 to 1, on which the distortion is one to one.
        verdict: In words.
    """

    name: LensName
    parameters: int
    rms_px: float
    hold_out_px: float
    bic: float
    monotonic_share: float
    verdict: str


@dataclass(frozen=True)
class ModelChoice:
    """The candidates and the reason for the winner.

    Attributes:
        chosen: The winner.
        rows: Every candidate, from few to many parameters.
        reason: In words.
    """

    chosen: LensName
    rows: tuple[ModelRow, ...]
    reason: str

"""What is varied to find a detector's limits, one thing at a time.

Markers of 100 mm before a camera of 640x480 pixels and 53 degrees of view, with clutter behind
them; where nothing else is said: sides of 40 px, tilts of 30 degrees, noise of 2 grey values,
0.6 px of blur, a linear camera.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

from tagmetry.lab.bench.setup import SIZE_M, Setup

SIZE_PX = (640, 480)
FAMILY = "tag36h11"

_MOST_MARKERS = 24
_ROOM = 1.95  # sides that a marker, its paper and what is free around it take


@dataclass(frozen=True)
class Sweep:
    """One thing that is varied.

    Attributes:
        label: What it is, with its unit.
        limit: What the last value is called at which nearly all markers are found.
        values: From the easiest to the hardest.
        change: Gives the usual setup the value.
        logarithmic: Its axis is.
    """

    label: str
    limit: str
    values: tuple[float, ...]
    change: Callable[[Setup, float], Setup]
    logarithmic: bool = True


SWEEPS: Mapping[str, Sweep] = MappingProxyType(
    {
        "side": Sweep(
            "side, px",
            "smallest, px",
            (100.0, 64.0, 45.0, 32.0, 25.0, 20.0, 17.0, 14.0, 12.0, 10.0, 8.0),
            lambda usual, value: replace(usual, side_px=value),
        ),
        "distance": Sweep(
            "distance, m",
            "farthest, m",
            (0.7, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.2, 5.0, 6.0),
            lambda usual, value: replace(usual, side_px=SIZE_PX[0] * SIZE_M / value),
        ),
        "tilt": Sweep(
            "tilt, degrees",
            "steepest, degrees",
            (0.0, 15.0, 30.0, 45.0, 60.0, 68.0, 74.0, 79.0),
            lambda usual, value: replace(usual, tilt_deg=value),
            logarithmic=False,
        ),
        "noise": Sweep(
            "noise, grey values",
            "noisiest, grey values",
            (0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0),
            lambda usual, value: replace(usual, noise=value),
        ),
        "blur": Sweep(
            "blur, px",
            "most blurred, px",
            (0.3, 0.6, 1.0, 1.5, 2.0, 2.6, 3.4),
            lambda usual, value: replace(usual, blur_px=value),
        ),
        "contrast": Sweep(
            "contrast, of full scale",
            "faintest",
            (0.7, 0.5, 0.3, 0.2, 0.1, 0.06, 0.03),
            lambda usual, value: replace(usual, contrast=value),
        ),
        "gamma": Sweep(
            "exponent of the camera",
            "most bent",
            (1.0, 1.4, 1.8, 2.2, 2.6),
            lambda usual, value: replace(usual, exponent=value),
            logarithmic=False,
        ),
        "motion": Sweep(
            "motion, px an image",
            "fastest, px an image",
            (0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 12.0, 16.0),
            lambda usual, value: replace(usual, motion_px=value),
            logarithmic=False,
        ),
        "light": Sweep(
            "light, electrons of a white pixel",
            "darkest, electrons",
            (10000.0, 3000.0, 1000.0, 300.0, 100.0, 50.0, 25.0, 12.0),
            lambda usual, value: replace(usual, white_electrons=value, noise=0.0),
        ),
    }
)


def setup_of(variable: str, value: float) -> Setup:
    """Return what to render where one thing has a value and the others are as usual."""
    usual = Setup(f"{variable} {value:g}", side_px=40.0, size_px=SIZE_PX, tilt_deg=30.0)
    changed = SWEEPS[variable].change(usual, value)
    return replace(changed, count=_count(changed.side_px))


def _count(side_px: float) -> int:
    """Return how many markers have room in the image."""
    columns, rows = (int(size_px / (_ROOM * side_px)) for size_px in SIZE_PX)
    return max(1, min(_MOST_MARKERS, columns * rows))

"""A picture of the focus law: measured pairs, fitted laws, and what is left."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from tagmetry.errors import InputError
from tagmetry.files.atomic import replace_file
from tagmetry.lens import FocusFit
from tagmetry.record.report.plot import BLUE, GOLD, RED, blank

_COLORS = (BLUE, RED, GOLD)
_KINDS = (".png", ".svg")


def write_focus_curve(
    path: Path, depths_m: Sequence[float], values: Sequence[float], fits: Mapping[str, FocusFit]
) -> None:
    """Write the curve above its residuals.

    Args:
        path: PNG or SVG.
        depths_m: Measured depths, shape (n,).
        values: The best focus at each.
        fits: Laws by name.

    Raises:
        InputError: The file is of another kind, or cannot be written.
        MissingExtraError: Matplotlib is not installed.
    """
    if path.suffix.lower() not in _KINDS:
        raise InputError(f"expected a picture {' or '.join(_KINDS)}, got {path.name}")
    figure, _ = blank(6.4, 5.6)
    figure.clear()
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    fine_m = np.geomspace(min(depths_m), max(depths_m), 200)
    for color, (name, fit) in zip(_COLORS, fits.items(), strict=False):
        curve = [fit.law.value(float(depth_m)) for depth_m in fine_m]
        above.plot(fine_m, curve, color=color, lw=1.3, label=f"{name}: rms {fit.rms:.2f}")
        below.plot(depths_m, fit.residuals, "o", ms=4, color=color)
    above.plot(depths_m, values, "o", ms=5, color="black", label="measured")
    above.set_ylabel("best focus")
    above.legend()
    below.set_ylabel("measured - law")
    below.set_xlabel("depth, m")
    below.set_xscale("log")
    with replace_file(path) as file:
        figure.savefig(file, format=path.suffix[1:].lower(), dpi=120)

"""A follower's distance and margins against the delay, with the measured delay marked."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.arena.stability import StabilityReport
from tagmetry.errors import InputError
from tagmetry.geometry import Array
from tagmetry.record.report.plot import BLUE, GOLD, LIGHT, RED, blank, png

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def stability_picture(reports: Sequence[StabilityReport], measured_s: float) -> bytes:
    """Return a PNG.

    Args:
        reports: By rising delay, at least two.
        measured_s: The delay that is marked.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    return png(stability_figure(reports, measured_s))


def stability_figure(reports: Sequence[StabilityReport], measured_s: float) -> "Figure":
    """Return the figure, not drawn yet."""
    if len(reports) < 2:
        raise InputError(f"a curve needs two delays at least, got {len(reports)}")
    figure, _ = blank(7.6, 6.4)
    figure.clear()
    above, below = figure.subplots(2, 1, sharex=True)
    _gaps(above, [one for one in reports if one.is_stable])
    _margins(below, reports)
    for axes in (above, below):
        axes.axvline(1000 * measured_s, color="0.3", ls="--", lw=1)
    above.annotate(
        f"{1000 * measured_s:g} ms", (1000 * measured_s, 1.0), xytext=(4, -12),
        xycoords=("data", "axes fraction"), textcoords="offset points", fontsize=9,
    )  # fmt: skip
    below.set_xlabel("delay from the image to the command's effect, ms")
    return figure


def _gaps(axes: "Axes", reports: Sequence[StabilityReport]) -> None:
    delays_ms = _delays_ms(reports)
    nearest, farthest, sure = (
        1000 * np.array([getattr(one, name) for one in reports])
        for name in ("nearest_m", "farthest_m", "gap_sd_m")
    )
    axes.fill_between(delays_ms, nearest - 3 * sure, farthest + 3 * sure, color=LIGHT, alpha=0.35)
    axes.plot(
        delays_ms, nearest, color=BLUE, label="nearest and farthest; shaded: and 3 sd of noise"
    )
    axes.plot(delays_ms, farthest, color=BLUE)
    for one in reports[:1]:
        axes.axhline(1000 * one.setting.spring.length_m, color="0.5", lw=0.8)
        axes.axhline(1000 * one.diameter_m, color=RED, label="the bodies touch")
    axes.set_ylabel("centre to centre, mm")
    axes.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0, 0.1))


def _margins(axes: "Axes", reports: Sequence[StabilityReport]) -> None:
    delays_ms = _delays_ms(reports)
    untold_ms = [1000 * min(one.along.delay_s, one.across.delay_s) for one in reports]
    phase_deg = [np.rad2deg(min(one.along.phase_rad, one.across.phase_rad)) for one in reports]
    axes.plot(delays_ms, untold_ms, color=BLUE, label="delay that nobody told, ms")
    axes.plot(delays_ms, phase_deg, color=GOLD, ls="-.", label="phase, degrees")
    axes.set(ylabel="what it bears on top", ylim=(0, None))
    axes.legend(fontsize=8)


def _delays_ms(reports: Sequence[StabilityReport]) -> Array:
    return 1000 * np.array([one.setting.delay_s for one in reports])

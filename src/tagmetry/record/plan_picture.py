"""What a plan promises, over the working volume."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.pose.plan import Setup, Volume
from tagmetry.record.report.plot import blank, png

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.contour import QuadContourSet

_NEAR_FLIPS = 0.01
_STEPS = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)


def plan_picture(setup: Setup, volume: Volume) -> bytes:
    """Return a PNG of the position's error, seen from above with the camera at the bottom.

    Args:
        setup: What is planned.
        volume: Its errors.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    figure, axes = blank(7.6, 6.0)
    mesh = _errors(axes, volume)
    figure.colorbar(
        mesh, ax=axes, label="error of the position, mm", ticks=mesh.levels, format="%g"
    )
    _flips(axes, volume)
    far_m = float(volume.z_m.max())
    left_m, right_m = volume.x_m[:, 0], volume.x_m[:, -1]
    for edge_m in (left_m, right_m):
        axes.plot([0, *edge_m], [0, *volume.z_m[:, 0]], color="0.3", linewidth=1)
    axes.plot(0, 0, "^", color="0.2", markersize=11, clip_on=False)
    axes.set_xlim(1.03 * left_m.min(), 1.03 * right_m.max())
    axes.set_ylim(0, 1.02 * far_m)
    axes.set_aspect("equal")
    axes.set_xlabel("to the right of the camera, m")
    axes.set_ylabel("before the camera, m")
    name, size_mm = setup.marker_family.name, 1000 * setup.size_m
    axes.set_title(f"{name} of {size_mm:.4g} mm, tilted {setup.tilt_deg:g}°", fontsize=11)
    return png(figure)


def _errors(axes: "Axes", volume: Volume) -> "QuadContourSet":
    """Draw the errors as bands between round numbers, and write these at their lines."""
    errors_mm = np.ma.masked_invalid(1000 * volume.position_m)
    levels = _round_levels(float(errors_mm.min()), float(errors_mm.max()))
    place = volume.x_m, volume.z_m, errors_mm
    mesh = axes.contourf(*place, levels=levels, cmap="viridis_r", norm="log")
    lines = axes.contour(*place, levels=levels[1:-1], colors="white", linewidths=0.8)
    axes.clabel(lines, fmt="%g mm", fontsize=9)
    return mesh


def _flips(axes: "Axes", volume: Volume) -> None:
    """Hatch where the wrong pose is found more than rarely."""
    share = np.ma.masked_invalid(volume.flip_probability)
    if share.max() > _NEAR_FLIPS:
        axes.contourf(
            volume.x_m, volume.z_m, share, levels=[_NEAR_FLIPS, 1.0], colors="none", hatches=["///"]
        )
        axes.text(
            0.02, 0.02, "hatched: flips in more than 1 %", transform=axes.transAxes, fontsize=9
        )


def _round_levels(low: float, high: float) -> list[float]:
    """Return round numbers from below a value to above another."""
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    levels = [step * 10.0**decade for decade in decades for step in _STEPS]
    first = max(n for n, level in enumerate(levels) if level <= low)
    last = min(n for n, level in enumerate(levels) if level >= high)
    return levels[first : max(last, first + 1) + 1]

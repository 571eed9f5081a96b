"""An arena's error map as seed 001's figure 9 has it, and as a table.

The colour is the radial error, an arrow shows where it points, and dots are the markers. Markers
that are lost altogether would drown the others: their errors have a colour of their own and no
arrow.
"""

import csv
import io
from typing import TYPE_CHECKING, Literal

import numpy as np

from tagmetry.arena.audit import ErrorMap
from tagmetry.geometry import Array
from tagmetry.record.report.plot import RED, blank, png

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.cm import ScalarMappable
    from matplotlib.figure import Figure

_COLUMNS = (
    "id", "x_m", "y_m", "measured_x_m", "measured_y_m", "error_x_m", "error_y_m", "error_m", "sd_m",
)  # fmt: skip
_LEAST_FOR_COLOUR = 6  # markers
_LOST = 3.0  # times the error that 98 % of the markers are within


def error_map_csv(found: ErrorMap) -> str:
    """Return a line for each marker: where it is, where it is said to be, and the error."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_COLUMNS)
    errors = found.measured_m - found.true_m
    numbers = np.column_stack([found.true_m, found.measured_m, errors, found.radial_m, found.sd_m])
    for marker_id, row in zip(found.ids.tolist(), numbers.tolist(), strict=True):
        writer.writerow([marker_id, *(f"{value:.6f}" for value in row)])
    return text.getvalue()


def error_map_picture(found: ErrorMap, title: str = "radial error") -> bytes:
    """Return a PNG of the map.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    return png(error_map_figure(found, title))


def error_map_figure(found: ErrorMap, title: str = "radial error") -> "Figure":
    """Return the figure, not drawn yet."""
    figure, axes = blank(8.2, 5.2)
    error_mm = 1000 * found.radial_m
    x, y = found.true_m.T
    shown = _coloured(axes, x, y, error_mm)
    figure.colorbar(shown, ax=axes, label="radial error, mm")
    axes.plot(x, y, ".", color="black", markersize=2)
    _arrows(axes, found)
    if _is_within(found):
        axes.plot(*found.foot_m, "+", color=RED, markersize=12, markeredgewidth=2)
    axes.set(xlabel="x, m", ylabel="y, m")
    axes.set_title(f"{title}: worst {_short(error_mm.max())} mm, {len(x)} markers", loc="left")
    axes.set_aspect("equal")
    return figure


def _arrows(axes: "Axes", found: ErrorMap) -> None:
    kept = found.radial_m <= _LOST * np.quantile(found.radial_m, 0.98)
    dx, dy = (found.measured_m - found.true_m)[kept].T
    x, y = found.true_m[kept].T
    arrows = axes.quiver(x, y, dx, dy, color="white", angles="xy", width=0.0018)
    rms_m = float(np.sqrt((found.radial_m[kept] ** 2).mean()))
    told = f"rms {_short(1000 * rms_m)} mm"
    axes.quiverkey(arrows, 0.93, 1.03, rms_m, told, labelpos="W", color="k")


def _short(value_mm: float) -> str:
    """Return a number to two digits, or to the whole where it has more."""
    return f"{value_mm:.2g}" if value_mm < 100 else f"{value_mm:.0f}"


def _coloured(axes: "Axes", x: Array, y: Array, error_mm: Array) -> "ScalarMappable":
    """Colour the floor between the markers, or the markers alone where they are few or in line."""
    spread = np.linalg.svd(np.stack([x - x.mean(), y - y.mean()]), compute_uv=False)
    if len(x) < _LEAST_FOR_COLOUR or spread[1] < 1e-3 * spread[0]:
        return axes.scatter(x, y, c=error_mm, cmap="viridis", s=60)
    most, usual = float(error_mm.max()), float(np.quantile(error_mm, 0.98))
    are_lost = most > _LOST * usual > 0
    levels = np.linspace(0.0, max(usual if are_lost else most, 1e-6), 13)
    extend: Literal["max", "neither"] = "max" if are_lost else "neither"
    return axes.tricontourf(x, y, error_mm, levels=levels, cmap="viridis", extend=extend)


def _is_within(found: ErrorMap) -> bool:
    low, high = found.true_m.min(axis=0), found.true_m.max(axis=0)
    return bool(((found.foot_m >= low) & (found.foot_m <= high)).all())

"""The panels of the bench's picture, and which cases each needs."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.bench import seed
from tagmetry.lab.bench.axes import both_logarithmic, dress, plain_numbers, x_logarithmic
from tagmetry.lab.bench.curves import BOUND, Abscissa, draw_bound, draw_curve, draw_curves
from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.setup import FULL_HD, Setup
from tagmetry.lab.bench.setups import SETUPS
from tagmetry.lab.engines import OURS, TRACKER
from tagmetry.lab.engines.palette import COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def available(results: Results) -> list[str]:
    """Return the names of the panels that the results have points for."""
    cases = {row.case for row in results.rows}
    curves = [name for name, setups in _NEEDED.items() if len(cases & _names(setups)) > 1]
    return [*(["trade"] if _weighed(results) else []), *curves]


def _time_and_error(axes: "Axes", results: Results) -> None:
    """Draw every engine's time and error on one case: the nearer to the lower left the better."""
    rows = _weighed(results)
    for row in rows:
        at = np.array([row.p50_ms, row.corner_rms_px], dtype=np.float64)
        colour = COLOURS.get(row.engine, "0.5")
        axes.plot(*at, "o", ms=8, color=colour, label=row.engine)
    if rows[0].bound_px is not None:
        axes.axhline(rows[0].bound_px, color="k", ls="--", lw=1, label=BOUND)
    dress(axes, f"Time and corners of {rows[0].case}", "ms, one thread", "rms, px")
    both_logarithmic(axes)


def _weighed(results: Results) -> list[Row]:
    """Return the rows of the standard case, or else of the first, that have time and error."""
    rows = [row for row in results.rows if row.p50_ms and row.corner_rms_px]
    cases = dict.fromkeys(row.case for row in rows)
    case = SETUPS[0].name if SETUPS[0].name in cases else next(iter(cases), None)
    return [row for row in rows if row.case == case and row.threads == rows[0].threads]


def _names(setups: Sequence[Setup]) -> set[str]:
    return {setup.name for setup in setups}


def _time_by_number(axes: "Axes", results: Results) -> None:
    draw_curves(axes, results, _COUNTS, lambda setup: setup.count, lambda row: row.p50_ms)
    dress(axes, "Time of a full HD image", "markers", "ms, one thread")
    both_logarithmic(axes)


def _time_by_noise(axes: "Axes", results: Results) -> None:
    draw_curves(axes, results, _NOISES, lambda setup: setup.noise, lambda row: row.p50_ms)
    dress(axes, "Time of 24 markers in noise", "noise, grey values", "ms, one thread")
    axes.set_yscale("log")
    plain_numbers(axes.yaxis)


def _error_by_side(axes: "Axes", results: Results) -> None:
    draw_curves(axes, results, _SIDES, lambda setup: setup.side_px, lambda row: row.corner_rms_px)
    draw_bound(axes, results, _SIDES)
    dress(axes, "Corners, linear camera", "side, px", "rms, px")
    both_logarithmic(axes)


def _error_by_side_with_gamma(axes: "Axes", results: Results) -> None:
    draw_curves(axes, results, _GAMMAS, lambda setup: setup.side_px, lambda row: row.corner_rms_px)
    draw_bound(axes, results, _GAMMAS)
    dress(axes, "Corners, gamma 2.2", "side, px", "rms, px")
    both_logarithmic(axes)


def _recall_by_side(axes: "Axes", results: Results) -> None:
    draw_curves(axes, results, _SIDES, lambda setup: setup.side_px, lambda row: row.recall)
    dress(axes, "Markers found", "side, px", "share")
    axes.set_ylim(-0.05, 1.05)
    x_logarithmic(axes)


def _images_by_robots(axes: "Axes", results: Results) -> None:
    def images_per_s(row: Row) -> float | None:
        return 1000 / row.p50_ms if row.p50_ms else None

    for engine, setups in ((OURS, _COUNTS), (TRACKER, _FILMS)):
        draw_curve(axes, results, engine, setups, lambda setup: setup.count, images_per_s)
    axes.plot(seed.ROBOTS, seed.IMAGES_PER_S, "ks--", label="seed 001, figure 10")
    axes.axhline(seed.CAMERA_HZ, color="0.6", lw=0.8)
    axes.annotate("its camera's limit", (1, seed.CAMERA_HZ), fontsize=7, va="bottom")
    axes.axhline(seed.LEAST_IMAGES_PER_S, color="0.6", lw=0.8, ls=":")
    axes.annotate("its slowest", (1, seed.LEAST_IMAGES_PER_S), fontsize=7, va="bottom")
    dress(axes, "Full HD images in a second", "robots", "1/s, one thread")
    both_logarithmic(axes)


def _like(names: Sequence[str], key: Abscissa) -> list[Setup]:
    """Return setups by the beginnings of their names, in the order of the abscissa."""
    found = [s for s in SETUPS if s.name.startswith(tuple(names)) and s.size_px == FULL_HD]
    return sorted(found, key=key)


_COUNTS = _like(["count-"], lambda setup: setup.count)
_SIDES = _like(["side-", "count-24"], lambda setup: setup.side_px)
_GAMMAS = _like(["gamma-"], lambda setup: setup.side_px)
_NOISES = [
    setup
    for setup in _like(["noise-", "count-24"], lambda setup: setup.noise)
    if setup.side_px == SETUPS[0].side_px
]
_FILMS = _like(["film-"], lambda setup: setup.count)

PANELS: dict[str, Callable[["Axes", Results], None]] = {
    "trade": _time_and_error,
    "time": _time_by_number,
    "noise": _time_by_noise,
    "corners": _error_by_side,
    "gamma": _error_by_side_with_gamma,
    "recall": _recall_by_side,
    "robots": _images_by_robots,
}
_NEEDED = {
    "time": _COUNTS,
    "noise": _NOISES,
    "corners": _SIDES,
    "gamma": _GAMMAS,
    "recall": _SIDES,
    "robots": _COUNTS,
}

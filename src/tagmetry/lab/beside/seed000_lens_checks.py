"""What must hold of seed 000's lens that is driven: its depths, turns and times."""

from collections.abc import Iterator, Sequence

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.beside.lens_readings import LensReadings, result_readings, rms
from tagmetry.lab.conclusions import Check
from tagmetry.lab.lens_row import LensReading
from tagmetry.lab.published.seed000 import seed000

_DEPTH_PERCENT = 0.3
_TURN_DEG = 0.5
_BOUNDS = 1.5
_OBLIQUE_DEG = 20.0  # from here on the paper promises more
_CONVERGED_S = 0.5
_MEDIAN_SCAN = 5
_COVERED = (0.90, 0.98)
_PERIOD_S = 1 / 30


def every_check(rows: Sequence[LensReading]) -> Iterator[Check]:
    """Give what must hold, condition by condition."""
    micro = result_readings(rows, method="tagmetry", size_m=0.01)
    over_depths = micro.where(figure="11")
    means = np.array([part.mean_percent for part in over_depths.conditions])
    yield Check(
        "depth over 0.05 to 1.05 m, mean of five at 0, 30 and 60 degrees",
        f"within {_DEPTH_PERCENT} % at every condition",
        f"worst {_worst(means):.3f} %; {np.isnan(means).sum()} of {len(means)} not always read",
        bool(np.isfinite(means).all() and np.abs(means).max() <= _DEPTH_PERCENT),
    )
    single = np.nan_to_num(np.abs(over_depths.errors_percent), nan=np.inf)
    yield Check(
        "depth, every single result",
        f"published {seed000().said('11', 'depth_percent').at:g} %",
        f"worst {single.max():.3f} %, median {np.median(single):.3f} %",
        bool(single.max() <= seed000().said("11", "depth_percent").at),
    )
    yield _turn_check(micro.where(figure="14"))
    covered = micro.covered_share()
    yield Check(
        "depths within 1.96 stated deviations",
        f"{100 * _COVERED[0]:g} to {100 * _COVERED[1]:g} %",
        f"{100 * covered:.1f} % of {len(micro.rows)}",
        _COVERED[0] <= covered <= _COVERED[1],
    )
    yield from _time_checks(micro)


def _turn_check(readings: LensReadings) -> Check:
    """Hold root mean squares against the bound; results with the other pose are counted apart."""
    worse, flips, total = 0, 0, 0
    for part in readings.conditions:
        flipped = part.flipped
        worse += bool(rms(part.errors_deg[~flipped]) > _allowed_deg(part))
        flips, total = flips + int(flipped.sum()), total + len(flipped)
    return Check(
        "turn at 0.05, 0.55 and 1.05 m, root mean square of five",
        f"within {_TURN_DEG} degrees or {_BOUNDS} bounds, the larger, and what is published",
        f"{worse} of {len(readings.conditions)} conditions worse; {flips} of {total} flipped",
        worse == 0,
    )


def _allowed_deg(part: LensReadings) -> float:
    is_oblique = part.rows[0].turn_deg >= _OBLIQUE_DEG
    published = seed000().said("14" if is_oblique else "14 near frontal", "turn_deg").at
    bound_deg = rms(part.column("bound_deg"))
    return min(max(_TURN_DEG, _BOUNDS * bound_deg), published)


def _time_checks(micro: LensReadings) -> Iterator[Check]:
    scanned, passed_s = micro.column("scanned"), micro.column("simulated_s")
    most, median = int(scanned.max()), float(np.median(scanned))
    yield Check(
        "images until the marker is found",
        f"at most {seed000().most_scan_images}, median at most {_MEDIAN_SCAN}",
        f"at most {most}, median {median:g}",
        most <= seed000().most_scan_images and median <= _MEDIAN_SCAN,
    )
    yield Check(
        "simulated time to converge from an unknown distance",
        f"at most {_CONVERGED_S} s",
        f"at most {passed_s.max():.2f} s, median {np.median(passed_s):.2f} s",
        bool(passed_s.max() <= _CONVERGED_S + 1e-9),
    )
    busy_s = micro.column("busy_s")
    yield Check(
        "computing time per image",
        f"less than {1000 * _PERIOD_S:.0f} ms",
        f"median {1000 * np.median(busy_s):.0f} ms",
        bool(np.median(busy_s) < _PERIOD_S),
    )


def _worst(values: Array) -> float:
    return float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else float("nan")

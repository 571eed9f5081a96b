"""Nine zones of the picture beside tables 1 and 2 of seed 002."""

from collections.abc import Sequence

import numpy as np

from tagmetry.lab.beside.sample import Mean, Sample, rounded, sample
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.published.seed002 import seed002
from tagmetry.lab.rows import Localization
from tagmetry.record.report import ReportTable

_ZONES = tuple(f"{v} {h}" for v in ("top", "middle", "bottom") for h in ("left", "centre", "right"))
_MEAN_OF_RAYLEIGH = float(np.sqrt(np.pi) / 2)  # of a length in the plane, by its rms
_SETUP = (
    "The paper does not tell the distance; 4 m is taken, with one marker of 200 mm parallel to the "
    "image. A size or a focal length that is 2.65 % too large gives 106 mm in depth all over the "
    "picture, as the paper has it; only the size leaves so little across. Half a pixel shows "
    "across alone."
)


def conclude(rows: Sequence[Localization]) -> Conclusions:
    """Return the tables zone by zone, and what mistakes do."""
    everything = sample(rows)
    right = everything.where(assumed="right")
    return Conclusions(
        checks=tuple(_checks(right)),
        tables=(_table(right), _mistakes(everything)),
        remarks=(_SETUP, *seed002().remarks[3:4]),
    )


def _checks(right: Sample) -> list[Check]:
    zones = seed002().zones
    printed = {
        "radial_m": ("radial error", [cm / 100 for cm in zones.radial_cm]),
        "xy_m": ("error in XY", [mm / 1000 for mm in zones.xy_mm]),
        "abs_z_m": ("error in Z", [cm / 100 for cm in zones.z_cm]),
    }
    return [_check(right, field, name, values_m) for field, (name, values_m) in printed.items()]


def _check(right: Sample, field: str, name: str, printed_m: Sequence[float]) -> Check:
    """Return whether no zone is worse; nothing is asked of zones where the corners tell less."""
    zones = right.ours.by("zone")
    means = [part.mean(field) for part in zones.values()]
    worse = [not _reaches(one, bound_m) for one, bound_m in zip(means, printed_m, strict=True)]
    able = [
        field != "xy_m" or _MEAN_OF_RAYLEIGH * part.mean("sd_radial_m").mean <= bound_m
        for part, bound_m in zip(zones.values(), printed_m, strict=True)
    ]
    asked = sum(is_worse and is_able for is_worse, is_able in zip(worse, able, strict=True))
    largest = max(means, key=lambda one: one.high)
    beyond = f"; in {able.count(False)} the noise of the corners alone makes more" * (False in able)
    return Check(
        f"{name} in each of the nine zones",
        "no larger than published, with 95 % confidence",
        f"{sum(worse)} of {len(means)} larger; largest {1000 * largest.mean:.2f} ± "
        f"{1000 * largest.half:.2f} mm{beyond}",
        asked == 0 if any(able) else None,
    )


def _reaches(mean: Mean, bound_m: float) -> bool:
    return bool(mean.missing == 0 and mean.high <= bound_m)


def _table(right: Sample) -> ReportTable:
    header = (
        "zone", "published radial mm", "ours mm", "±", "its steps mm", "published XY mm", "ours mm",
        "its steps mm", "published Z mm", "ours mm", "its steps mm", "better?",
    )  # fmt: skip
    by_zone = right.by("zone")
    rows = tuple(_row(zone, part) for zone, part in by_zone.items())
    return ReportTable("seed002_zones", "Tables 1 and 2: nine zones of the picture", header, rows)


def _row(zone: float, part: Sample) -> tuple[float | str, ...]:
    printed, n = seed002().zones, int(zone)
    radial, ours, paper = part.ours.mean("radial_m"), part.ours, part.paper
    return (
        _ZONES[n],
        10 * printed.radial_cm[n],
        rounded(1000 * radial.mean),
        rounded(1000 * radial.half),
        rounded(1000 * paper.mean("radial_m").mean),
        printed.xy_mm[n],
        rounded(1000 * ours.mean("xy_m").mean),
        rounded(1000 * paper.mean("xy_m").mean),
        10 * printed.z_cm[n],
        rounded(1000 * ours.mean("abs_z_m").mean),
        rounded(1000 * paper.mean("abs_z_m").mean),
        "yes" if radial.high <= printed.radial_cm[n] / 100 else "no",
    )


def _mistakes(everything: Sample) -> ReportTable:
    zones = seed002().zones
    published = (
        "published", 10 * float(np.mean(zones.radial_cm)), float(np.mean(zones.xy_mm)),
        10 * float(np.mean(zones.z_cm)), 10 * float(np.ptp(zones.z_cm)),
    )  # fmt: skip
    names = everything.kinds("assumed")
    rows = tuple(_mistake(everything.ours.where(assumed=name), name) for name in names)
    header = ("what is wrong", "radial mm", "XY mm", "Z mm", "range of Z over the zones mm")
    return ReportTable(
        "seed002_zone_mistakes", "One thing wrong at a time, ours", header, (published, *rows)
    )


def _mistake(rows: Sample, name: str) -> tuple[float | str, ...]:
    by_zone = [1000 * part.mean("abs_z_m").mean for part in rows.by("zone").values()]
    errors = [1000 * rows.mean(field).mean for field in ("radial_m", "xy_m", "abs_z_m")]
    return (name, *map(rounded, [*errors, float(np.ptp(by_zone))]))

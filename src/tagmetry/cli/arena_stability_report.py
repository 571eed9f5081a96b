"""How safely a robot follows another, as text and as JSON."""

from math import degrees, isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from tagmetry.arena.stability import Margins, StabilityReport


def stability_lines(report: "StabilityReport") -> tuple[str, ...]:
    """Return what a report says, line by line."""
    delay_ms = 1000 * report.setting.delay_s
    if not report.is_stable:
        return (f"stability at {delay_ms:.0f} ms: it swings up; take a softer spring",)
    return (
        f"stability at {delay_ms:.0f} ms, along: {_told(report.along)}",
        f"stability at {delay_ms:.0f} ms, facing: {_told(report.across)}",
        f"expected: {1000 * report.nearest_m:.1f} to {1000 * report.farthest_m:.1f} mm apart, "
        f"noise {3000 * report.gap_sd_m:.1f} mm (3 sd), overshoot {100 * report.overshoot:.0f} %; "
        + _air(report),
    )


def stability_table(report: "StabilityReport") -> dict[str, object]:
    """Return a report as JSON has it: null for what has no end."""
    named = ("overshoot", "nearest_m", "farthest_m", "gap_sd_m", "worst_m", "air_m")
    numbers = {name: _finite(getattr(report, name)) for name in named}
    margins = {
        part: {name: _finite(value) for name, value in vars(getattr(report, part)).items()}
        for part in ("along", "across")
    }
    return {"delay_s": report.setting.delay_s, "is_stable": report.is_stable, **margins, **numbers}


def _told(one: "Margins") -> str:
    return (
        f"gain x {one.gain:.1f}, phase {degrees(one.phase_rad):.0f} deg, "
        f"{1000 * one.delay_s:.0f} ms later than told"
    )


def _air(report: "StabilityReport") -> str:
    if report.air_m < 0:
        return "the bodies may touch"
    return f"{1000 * report.air_m:.1f} mm of air left"


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None

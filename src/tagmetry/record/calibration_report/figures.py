"""The figures of a report, each with its title and a text for those who do not see it."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.record.calibration_report.facts import CalibrationFacts
from tagmetry.record.calibration_report.tables import view_names
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import (
    BLUE,
    GOLD,
    LIGHT,
    RED,
    blank,
    image_axes,
    log_colors,
    plain_ticks,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST_NAMED = 40


def every_figure(facts: CalibrationFacts) -> tuple[ReportFigure, ...]:
    """Return all figures of a calibration, not drawn yet."""
    poses = (_poses(facts),) if facts.pose_errors else ()
    return (
        _uncertainty(facts),
        _residuals(facts),
        _coverage(facts),
        _tilts(facts),
        _errors(facts),
        *poses,
    )


def _uncertainty(facts: CalibrationFacts) -> ReportFigure:
    uncertainty = facts.evidence.uncertainty
    u, v = uncertainty.worst_pixel

    def draw() -> "Figure":
        figure, axes = blank()
        sd_px = np.ma.masked_invalid(uncertainty.sd_px)
        levels = _levels(sd_px.compressed())
        x, y = uncertainty.pixels[..., 0], uncertainty.pixels[..., 1]
        filled = axes.contourf(
            x, y, sd_px, levels=levels, cmap="cividis", norm=log_colors(levels), extend="both"
        )
        lines = axes.contour(x, y, sd_px, levels=levels, colors="white", linewidths=0.6)
        axes.clabel(lines, fmt="%g", fontsize=8)
        seen = np.concatenate([view.corners_px for view in facts.calibration.views])
        axes.plot(*seen.T, ".", ms=1.5, color="white", alpha=0.5)
        figure.colorbar(filled, ax=axes, label="standard deviation, px", ticks=levels, format="%g")
        image_axes(axes, facts.calibration.camera.size_px)
        return figure

    return ReportFigure(
        "uncertainty",
        "How uncertain projections are over the image",
        f"One standard deviation in the worst direction: {uncertainty.middle_px:.2f} px at a "
        f"middling place, {uncertainty.worst_px:.2f} px at worst, at ({u:.0f}, {v:.0f}). White "
        "points: corners that were seen.",
        draw,
    )


def _levels(values: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> list[float]:
    """Return round numbers, two or three a decade, that span values."""
    low, high = np.percentile(values, [1, 99]) if values.size else (0.1, 1.0)
    decades = range(
        int(np.floor(np.log10(max(low, 1e-4)))), int(np.ceil(np.log10(high + 1e-4))) + 1
    )
    steps = [round(m * 10.0**d, 6) for d in decades for m in (1, 2, 5)]
    inside = [step for step in steps if low / 2.5 <= step <= high * 2.5]
    return inside if len(inside) >= 2 else [low, high + 1e-6]


def _residuals(facts: CalibrationFacts) -> ReportFigure:
    field = facts.evidence.residuals
    over = field.over_image

    def draw() -> "Figure":
        figure, axes = blank()
        image_axes(axes, facts.calibration.camera.size_px)
        known = over.count >= 3
        x, y = over.places[known].T
        dx, dy = over.mean_px[known].T
        step_px = facts.calibration.camera.width_px / 10
        longest = max(float(np.hypot(dx, dy).max(initial=0.0)), 1e-9)
        arrows = axes.quiver(
            x,
            y,
            dx,
            dy,
            angles="xy",
            scale_units="xy",
            scale=longest / (0.8 * step_px),
            color=BLUE,
            clip_on=False,
        )
        axes.set_title(" ")  # room for the key
        key_px = _round_down(longest)
        axes.quiverkey(arrows, 0.87, 1.04, key_px, f"{key_px:g} px", labelpos="E")
        return figure

    pattern = "a pattern" if over.is_pattern else "no more than noise gives"
    return ReportFigure(
        "residuals",
        "What the errors have in common over the image",
        f"Mean of seen minus predicted in each cell: {over.rms_px:.3f} px, which is {pattern} "
        f"(p = {over.p_value:.2g}); a corner's noise is {field.noise_px:.3f} px along an axis.",
        draw,
    )


def _round_down(value: float) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * max(m for m in (1, 2, 5) if m <= value / power * (1 + 1e-9)))


def _coverage(facts: CalibrationFacts) -> ReportFigure:
    covered = facts.evidence.coverage

    def draw() -> "Figure":
        figure, axes = blank()
        size_px = facts.calibration.camera.size_px
        axes.grid(visible=False)
        extent = (-0.5, size_px[0] - 0.5, size_px[1] - 0.5, -0.5)
        cells = np.ma.masked_equal(covered.cells, 0)
        shown = axes.imshow(cells, extent=extent, cmap="cividis", alpha=0.85)
        for view in facts.calibration.views:
            axes.plot(*view.corners_px.T, ".", ms=2, color="white", alpha=0.7)
        figure.colorbar(shown, ax=axes, label="corners in a cell")
        image_axes(axes, size_px)
        return figure

    return ReportFigure(
        "coverage",
        "Where corners were seen",
        f"Corners lie in {covered.share:.0%} of {covered.cells.size} cells; blank cells have none. "
        f"The farthest is {covered.farthest_share:.0%} of the way to the image's corners.",
        draw,
    )


def _tilts(facts: CalibrationFacts) -> ReportFigure:
    covered = facts.evidence.coverage

    def draw() -> "Figure":
        figure, axes = blank(7.0, 4.0)
        angle = np.radians(covered.tilt_directions_deg)
        x, y = covered.tilts_deg * np.cos(angle), covered.tilts_deg * np.sin(angle)
        shown = axes.scatter(x, y, c=covered.distances_m, cmap="cividis", s=45, zorder=3)
        figure.colorbar(shown, ax=axes, label="distance, m")
        reach = max(50.0, float(covered.tilts_deg.max()) + 5)
        axes.set(xlim=(-reach, reach), ylim=(reach, -reach), aspect="equal")
        axes.set_xlabel("face turned to the right, degrees")
        axes.set_ylabel("face turned down, degrees")
        return figure

    tilts, distances = covered.tilts_deg, covered.distances_m
    return ReportFigure(
        "tilts",
        "How the board was held",
        f"Tilts from {tilts.min():.0f} to {tilts.max():.0f} degrees, distances from "
        f"{distances.min():.2f} to {distances.max():.2f} m. Each point is a view.",
        draw,
    )


def _errors(facts: CalibrationFacts) -> ReportFigure:
    calibration, left_out = facts.calibration, facts.evidence.left_out

    def draw() -> "Figure":
        figure, axes = blank(7.0, 3.6)
        place = np.arange(len(calibration.views))
        axes.bar(place - 0.2, calibration.view_rms_px, 0.4, color=LIGHT, label="fitted")
        if left_out is not None:
            axes.bar(place + 0.2, left_out.view_px, 0.4, color=GOLD, label="when left out")
        axes.axhline(calibration.rms_px, color=RED, lw=1, ls="--", label="all, fitted")
        axes.set_ylabel("root mean square error, px")
        if len(place) <= _MOST_NAMED:
            axes.set_xticks(place, view_names(calibration), rotation=90, fontsize=7)
        else:
            axes.set_xlabel("view")
        axes.legend(ncols=3, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, 1.16))
        axes.grid(visible=False, axis="x")
        return figure

    worst = int(np.argmax(calibration.view_rms_px))
    out = "" if left_out is None else f" (left out: {left_out.rms_px:.3f} px)"
    return ReportFigure(
        "errors",
        "Error of each view",
        f"{calibration.rms_px:.3f} px over all{out}; the worst is {view_names(calibration)[worst]} "
        f"with {calibration.view_rms_px[worst]:.3f} px.",
        draw,
    )


def _poses(facts: CalibrationFacts) -> ReportFigure:
    def draw() -> "Figure":
        figure, axes = blank(7.0, 3.6)
        names = dict.fromkeys(one.name for one in facts.pose_errors)
        for name, color, mark in zip(names, (BLUE, GOLD, RED), "os^", strict=False):
            own = [one.error for one in facts.pose_errors if one.name == name]
            distances = [error.place.distance_m for error in own]
            mm = [error.worst_mm for error in own]
            axes.plot(distances, mm, marker=mark, color=color, label=name)
        axes.set(xscale="log", yscale="log", xlabel="distance, m", ylabel="worst direction, mm")
        plain_ticks(axes)
        axes.legend(fontsize=8)
        return figure

    size_mm = 1e3 * facts.pose_errors[0].size_m
    return ReportFigure(
        "pose_errors",
        "What the calibration does to a marker's position",
        f"One standard deviation for a marker of {size_mm:.0f} mm tilted by 30 degrees, by the "
        "calibration alone: it does not average out. Numbers stand in the table below.",
        draw,
    )

"""What a camera's ways above seed 002's markers say of the filter."""

from collections.abc import Iterator, Sequence

import numpy as np
from scipy.special import chdtri

from tagmetry.geometry import Array
from tagmetry.lab.beside.sample import Sample, mean_of, rounded, sample, told_of
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.rows import Followed
from tagmetry.record.report import Cell, ReportTable

_SETTLED = 5  # images after which the filter knows the speeds
_LOST_S = 1.0
_REMARK = (
    "The camera moves as the filter's model has it, from rest, with accelerations of 0.2 m/s per "
    "root second and turns of 0.03 rad/s per root second. Stated covariances are a little too "
    "large on the simulator's clean pictures, which makes innovations small; those of one marker "
    "far off are not normal."
)


def conclude(rows: Sequence[Followed]) -> Conclusions:
    """Return whether innovations are as they should be, and what every method errs."""
    everything = sample(rows)
    followed = everything.where(method="filter")
    several = followed.without(layout="one")
    return Conclusions(
        checks=(
            _surprise_check("two or more markers", several),
            _surprise_check("one marker", followed.where(layout="one")),
            _loss_check(followed),
        ),
        tables=(_by_method(everything), _surprises(followed)),
        remarks=(_REMARK,),
    )


def _surprise_check(name: str, followed: Sample) -> Check:
    found = _surprises2(followed)
    low, high = _band(len(found))
    mean = float(found.mean()) if len(found) else float("nan")
    return Check(
        f"{name}: mean normalised innovation squared of {len(found)} images",
        f"{low:.2f} to {high:.2f}, the 95 % band",
        f"{mean:.2f}",
        bool(low <= mean <= high),
    )


def _band(count: int) -> tuple[float, float]:
    """Return where the mean of so many chi-squared numbers with 6 degrees lies in 95 of 100."""
    several = max(count, 1)
    return float(chdtri(6 * several, 0.975)) / several, float(chdtri(6 * several, 0.025)) / several


def _surprises2(followed: Sample) -> Array:
    """Return the squared innovations of the images that follow each other."""
    values = _steady(followed).values("surprise2")
    return np.asarray(values[np.isfinite(values)])


def _steady(part: Sample) -> Sample:
    """Return the images before the loss in which the filter knows the speeds."""
    kept = [row for row in part.rows if isinstance(row, Followed) and row.image >= _SETTLED]
    return Sample(tuple(row for row in kept if row.gap_s < _LOST_S))


def _loss_check(followed: Sample) -> Check:
    """Return whether the first image after the loss that shows a marker is heeded."""
    after = Sample(
        tuple(row for row in followed.rows if isinstance(row, Followed) and row.gap_s >= _LOST_S)
    )
    seen = after.values("radial_m")[np.isfinite(after.values("radial_m"))]
    heeded = int(np.isfinite(after.values("surprise2")).sum())
    return Check(
        "after 2 s without markers, the first image that shows any is heeded",
        f"all {len(seen)}",
        f"{heeded}, {told_of(mean_of(seen), 1000.0, 'mm')} off",
        heeded == len(seen) > 0,
    )


def _by_method(everything: Sample) -> ReportTable:
    layouts = everything.kinds("layout")
    lines: list[tuple[Cell, ...]] = [
        (method, *(_cell(everything.where(method=method, layout=layout)) for layout in layouts))
        for method in everything.methods
    ]
    title = "Rms radial error along the ways, mm"
    return ReportTable("seed002_way", title, ("method", *layouts), tuple(lines))


def _cell(part: Sample) -> float:
    errors_m = _steady(part).values("radial_m")
    return rounded(1000 * float(np.sqrt(np.nanmean(errors_m**2))))


def _surprises(followed: Sample) -> ReportTable:
    lines: list[tuple[Cell, ...]] = [
        (layout, distance_m, *_numbers(here))
        for layout in followed.kinds("layout")
        for distance_m, here in followed.where(layout=layout).by("distance_m").items()
    ]
    header = ("markers", "distance m", "images", "mean surprise (6 is right)", "mean Mahalanobis")
    title = "The filter's innovations and errors by their covariances"
    return ReportTable("seed002_surprise", title, header, tuple(lines))


def _numbers(here: Sample) -> Iterator[float]:
    found = _surprises2(here)
    yield len(found)
    yield rounded(float(found.mean())) if len(found) else float("nan")
    yield rounded(here.mean("mahalanobis2").mean)

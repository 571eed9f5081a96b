"""Judge what the engines found on a case, and put it into rows."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from tagmetry.geometry import Array
from tagmetry.lab.bench.agreement import agreed
from tagmetry.lab.bench.bound import bound_px
from tagmetry.lab.bench.case import Case, Truth
from tagmetry.lab.bench.matching import Matches, matched
from tagmetry.lab.bench.poses import PoseErrors, pose_errors
from tagmetry.lab.bench.rounds import Course, clock_of
from tagmetry.lab.bench.row import Row
from tagmetry.lab.engines import OURS


def scored(case: Case, courses: Sequence[Course], threads: int) -> list[Row]:
    """Return a row for every engine."""
    truths = case.truths or agreed(courses, len(case.images))
    least_px = bound_px(case)
    rows = [replace(_row(case, course, truths, threads), bound_px=least_px) for course in courses]
    return _with_ratios(rows)


def _row(case: Case, course: Course, truths: Sequence[Truth], threads: int) -> Row:
    row = Row(
        case.name,
        course.kind.name,
        threads,
        clock_of(threads),
        float(np.mean([image.size for image in case.images])) / 1e6,
        judged_by="truth" if case.truths is not None else "agreement",
    )
    if course.failure is not None:
        return replace(row, failure=course.failure.reason)
    return _judged(_timed(row, course), case, course, truths)


def _timed(row: Row, course: Course) -> Row:
    p50_ms, p99_ms = 1000 * np.percentile(course.times_s, [50, 99])
    memory_mib = course.memory_mib if np.isfinite(course.memory_mib) else None
    return replace(
        row,
        rounds=len(course.times_s),
        p50_ms=float(p50_ms),
        p99_ms=float(p99_ms),
        memory_mib=memory_mib,
    )


def _judged(row: Row, case: Case, course: Course, truths: Sequence[Truth]) -> Row:
    looked_at = sorted(course.found)
    pairs = {n: matched(course.found[n], truths[n]) for n in looked_at}
    row = replace(
        row,
        expected=sum(len(truths[n].ids) for n in looked_at),
        found=sum(len(pairs[n].true) for n in looked_at),
        false_positives=sum(pairs[n].false for n in looked_at),
    )
    if row.found == 0:
        return row
    off_px = np.concatenate([_off_px(course, truths[n], pairs[n], n) for n in looked_at])
    row = replace(
        row,
        corner_rms_px=float(np.sqrt(np.mean(off_px**2))),
        distance2=_distance2(course, pairs, off_px) if case.truths is not None else None,
    )
    return _with_pose(row, _pose_errors(case, course, truths, pairs))


def _off_px(course: Course, truth: Truth, pairs: Matches, n: int) -> Array:
    """Return the corners' errors in an image, shape (k, 4, 2)."""
    return course.found[n].corners_px[pairs.found] - truth.corners_px[pairs.true]


def _distance2(course: Course, pairs: dict[int, Matches], off_px: Array) -> float | None:
    """Return the mean of d' inv(C) d over all markers, None where no covariance is stated."""
    stated = [
        covariances_px2[both.found]
        for n, both in pairs.items()
        if (covariances_px2 := course.found[n].covariances_px2) is not None
    ]
    if not stated:
        return None
    d = off_px.reshape(-1, 8, 1)
    return float(np.mean(d.swapaxes(1, 2) @ np.linalg.solve(np.concatenate(stated), d)))


def _pose_errors(
    case: Case, course: Course, truths: Sequence[Truth], pairs: dict[int, Matches]
) -> list[PoseErrors]:
    """Return the poses' errors of every image where both are known."""
    if case.seen is None:
        return []
    return [
        pose_errors(course.found[n].corners_px[both.found], Ts[both.true], case.seen)
        for n, both in pairs.items()
        if len(both.true) and (Ts := truths[n].Ts_camera_marker) is not None
    ]


def _with_pose(row: Row, errors: Sequence[PoseErrors]) -> Row:
    position_percent = [p for one in errors for p in one.position_percent]
    if not position_percent:
        return row
    return replace(
        row,
        position_error_percent=float(np.median(position_percent)),
        angle_error_deg=float(np.median([a for one in errors for a in one.angle_deg])),
        flips=sum(one.flips for one in errors),
    )


def _with_ratios(rows: list[Row]) -> list[Row]:
    """Return the rows with their times as multiples of ours."""
    ours = next((row.p50_ms for row in rows if row.engine == OURS), None)
    if not ours:
        return rows
    return [replace(row, ratio=row.p50_ms / ours) if row.p50_ms else row for row in rows]

"""What this project wants to hold, against the results of a run."""

from collections.abc import Iterator, Sequence

from tagmetry.lab.bench.goal import Goal
from tagmetry.lab.bench.real import SMALL_FAMILIES, STRONG_FAMILIES
from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.setups import EXACT
from tagmetry.lab.engines import OURS, TRACKER

_TIMED = ("side-30", "count-24", "side-100", "noise-8-30", "noise-8", "noise-8-100")
_FOUND = ("side-20", "side-30", "count-24", "side-100")
_TIMES_BOUND, _FLOOR_PX = 1.3, 0.004
_SLOWEST_MS = 250.0


def goals(results: Results) -> list[Goal]:
    """Return what can be said after a run."""
    return [
        *_times(results),
        *_tracking(results),
        *_recalls(results),
        *_corners(results),
        *_covariances(results),
        *_false_positives(results),
        *_slowest(results),
    ]


def _times(results: Results) -> Iterator[Goal]:
    for case in _TIMED:
        ours, peers = _ours(results, case), _peers(results, case)
        fair = [row.p50_ms for row in peers if row.p50_ms and row.found == row.expected]
        if ours and ours.p50_ms and fair:
            yield Goal(
                f"{case}: time, as a share of the fastest peer's", ours.p50_ms / min(fair), 0.2
            )


def _tracking(results: Results) -> Iterator[Goal]:
    ours, tracker = _ours(results, "film-24"), results.of("film-24", TRACKER, 1)
    if ours and tracker and ours.p50_ms and tracker.p50_ms:
        yield Goal(
            "film-24: tracker's time, as a share of the detector's",
            tracker.p50_ms / ours.p50_ms,
            0.25,
        )
    for row in results.rows:
        if (row.case, row.engine) == ("film-360", TRACKER) and row.threads > 1 and row.p50_ms:
            yield Goal("film-360: images a second, all threads", 1000 / row.p50_ms, 60.0, True)


def _recalls(results: Results) -> Iterator[Goal]:
    for case in _FOUND:
        ours = _ours(results, case)
        best = max((row.recall or 0.0 for row in _peers(results, case)), default=None)
        if ours and ours.recall is not None and best is not None:
            yield Goal(f"{case}: share found, and the best peer's", ours.recall, best, True)


def _corners(results: Results) -> Iterator[Goal]:
    for setup in EXACT:
        ours = _ours(results, setup.name)
        if ours and ours.corner_rms_px and ours.bound_px:
            most_px = _TIMES_BOUND * ours.bound_px + _FLOOR_PX
            yield Goal(
                f"{setup.name}: corners, px", ours.corner_rms_px, most_px, bound=ours.bound_px
            )
    for setup in EXACT:
        if setup.exponent != 1.0:
            yield from _share_of_the_best(results, setup.name)


def _share_of_the_best(results: Results, case: str) -> Iterator[Goal]:
    ours = _ours(results, case)
    peers_px = [row.corner_rms_px for row in _peers(results, case) if row.corner_rms_px]
    if ours and ours.corner_rms_px and ours.bound_px and peers_px:
        best_px = min(peers_px)
        yield Goal(
            f"{case}: corners by the best peer's",
            ours.corner_rms_px / best_px,
            0.2,
            bound=ours.bound_px / best_px,
        )


def _covariances(results: Results) -> Iterator[Goal]:
    for setup in EXACT:
        ours = _ours(results, setup.name)
        if ours and ours.distance2 is not None:
            off = abs(ours.distance2 - 8)
            yield Goal(f"{setup.name}: squared distance, off 8", off, 1.0)


def _false_positives(results: Results) -> Iterator[Goal]:
    for case in ("none", "hostile", *(f"free-{name}" for name in STRONG_FAMILIES)):
        if ours := _ours(results, case):
            yield Goal(f"{case}: false positives", ours.false_positives, 0.0)
    for case in (f"free-{name}" for name in SMALL_FAMILIES):
        ours, theirs = _ours(results, case), results.of(case, "opencv-none", 1)
        if ours and theirs and theirs.failure is None:
            name = f"{case}: false positives, and a third of OpenCV's"
            yield Goal(name, ours.false_positives, theirs.false_positives / 3)


def _slowest(results: Results) -> Iterator[Goal]:
    ours = _ours(results, "hostile")
    if ours and ours.p99_ms:
        yield Goal("hostile: slowest image, ms", ours.p99_ms, _SLOWEST_MS)


def _ours(results: Results, case: str) -> Row | None:
    return results.of(case, OURS, 1)


def _peers(results: Results, case: str) -> Sequence[Row]:
    """Return the rows of everybody else, with one thread."""
    return [
        row
        for row in results.rows
        if row.case == case and row.threads == 1 and row.engine not in (OURS, TRACKER)
    ]

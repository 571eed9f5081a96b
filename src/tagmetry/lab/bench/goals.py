"""What this project wants to hold, against the results of a run."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row
from tagmetry.lab.engines import OURS, TRACKER

_TIMED = ("side-30", "count-24", "side-100", "noise-8-30", "noise-8", "noise-8-100")
_FOUND = ("side-20", "side-30", "count-24", "side-100")
_LINEAR = ("side-30", "count-24", "side-100", "noise-16")
_GAMMA = ("gamma-30", "gamma-60", "gamma-100")
_EMPTY = ("none", "real-marker_free")
_FLOOR_PX = 0.004


@dataclass(frozen=True)
class Goal:
    """One thing that is to hold.

    Attributes:
        name: What is asked, with the case.
        measured: In this run.
        wanted: The limit.
        at_least: The limit is the least, and not the most.
    """

    name: str
    measured: float
    wanted: float
    at_least: bool = False

    @property
    def holds(self) -> bool:
        """Whether it does."""
        if self.at_least:
            return self.measured >= self.wanted
        return self.measured <= self.wanted


def goals(results: Results) -> list[Goal]:
    """Return what can be said after a run."""
    return [
        *_times(results),
        *_tracking(results),
        *_recalls(results),
        *_corners(results),
        *_covariances(results),
        *_false_positives(results),
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
    for case in (*_LINEAR, *_GAMMA):
        ours = _ours(results, case)
        if ours and ours.corner_rms_px and ours.bound_px:
            least_px = 1.3 * ours.bound_px + _FLOOR_PX
            yield Goal(f"{case}: corners, px", ours.corner_rms_px, least_px)
    for case in _GAMMA:
        ours = _ours(results, case)
        peers_px = [row.corner_rms_px for row in _peers(results, case) if row.corner_rms_px]
        if ours and ours.corner_rms_px and peers_px:
            share = ours.corner_rms_px / min(peers_px)
            yield Goal(f"{case}: corners, as a share of the best peer's", share, 0.2)


def _covariances(results: Results) -> Iterator[Goal]:
    """Judge the stated covariance over all of these cases together, for the sake of numbers."""
    rows = [ours for case in (*_LINEAR, *_GAMMA) if (ours := _ours(results, case))]
    weighed = [(row.distance2, row.found) for row in rows if row.distance2 is not None]
    if weighed:
        mean = sum(d2 * count for d2, count in weighed) / sum(count for _, count in weighed)
        yield Goal("stated covariance: mean squared distance, off 8", abs(mean - 8), 1.0)


def _false_positives(results: Results) -> Iterator[Goal]:
    for case in _EMPTY:
        if ours := _ours(results, case):
            yield Goal(f"{case}: false positives", ours.false_positives, 0.0)


def _ours(results: Results, case: str) -> Row | None:
    return results.of(case, OURS, 1)


def _peers(results: Results, case: str) -> Sequence[Row]:
    """Return the rows of everybody else, with one thread."""
    return [
        row
        for row in results.rows
        if row.case == case and row.threads == 1 and row.engine not in (OURS, TRACKER)
    ]

"""Measure what is not finished yet, and keep each case as soon as it is.

Only as many cases are handed out as there are workers, so that an interruption waits for no more
than those; what they finish is kept too.
"""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from dataclasses import dataclass
from typing import Any

from tagmetry import __version__
from tagmetry.errors import InputError
from tagmetry.lab.experiment import Record
from tagmetry.lab.sweep.folder import Sweep
from tagmetry.lab.sweep.name import case_seed, settings_json
from tagmetry.lab.sweep.workers import Workers


@dataclass(frozen=True)
class Measured:
    """A case's rows, and the version of the software that measured them."""

    version: str
    rows: Sequence[Any]


def run(sweep: Sweep, workers: Workers) -> Iterator[Record]:
    """Measure the unfinished cases, and give each one when it is kept.

    Raises:
        InputError: A case cannot be measured or kept, or a worker died.
    """
    waiting = iter(sweep.unfinished())
    busy: dict[Future[Measured], Record] = {}
    try:
        while _hand_out(sweep, workers, waiting, busy) or busy:
            done, _ = wait(busy, return_when=FIRST_COMPLETED)
            yield from [_kept(sweep, future, busy.pop(future)) for future in done]
    except BrokenExecutor as error:
        raise InputError(
            "a worker died, perhaps for want of memory; what is finished is kept: run the same "
            "command again, with fewer --jobs"
        ) from error
    finally:
        for future in busy:
            future.cancel()
        for future in wait(busy).done:
            _keep_what_is_good(sweep, future, busy[future])


def measured(measure: Callable[[Any, int], Sequence[Any]], case: Record, seed: int) -> Measured:
    """Measure a case; this runs in a worker."""
    return Measured(__version__, measure(case, seed))


def _hand_out(
    sweep: Sweep,
    workers: Workers,
    waiting: Iterator[Record],
    busy: dict[Future[Measured], Record],
) -> int:
    """Give the free workers a case each; return how many got one."""
    free = workers.count - len(busy)
    cases = [case for _, case in zip(range(free), waiting, strict=False)]
    for case in cases:
        seed = case_seed(sweep.experiment, case, sweep.seed)
        busy[workers.executor.submit(measured, sweep.experiment.measure, case, seed)] = case
    return len(cases)


def _kept(sweep: Sweep, future: "Future[Measured]", case: Record) -> Record:
    try:
        found = future.result()
    except InputError as error:
        raise InputError(f"{sweep.experiment.name} {settings_json(case)}: {error}") from error
    if found.version != __version__:
        raise InputError(
            f"a worker has tagmetry {found.version}, this is {__version__}; install the same "
            f"version on all machines"
        )
    sweep.keep(case, found.rows)
    return case


def _keep_what_is_good(sweep: Sweep, future: "Future[Measured]", case: Record) -> None:
    """Keep a case that was finished after something else had gone wrong."""
    if not future.cancelled() and future.exception() is None:
        _kept(sweep, future, case)

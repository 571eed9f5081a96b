"""The bench: all engines on all cases, case by case."""

from collections.abc import Generator, Sequence
from dataclasses import replace

from tagmetry.lab.bench.costs import costs
from tagmetry.lab.bench.machine import this_machine
from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.rounds import Pace, raced
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.score import scored
from tagmetry.lab.bench.setups import SETUPS
from tagmetry.lab.bench.team import Team
from tagmetry.lab.bench.works import Step
from tagmetry.lab.engines import EngineKind


def bench(
    to_do: Sequence[Step], kinds: Sequence[EngineKind], family: str, pace: Pace
) -> Generator[Results]:
    """Measure engines; give the results so far after every case.

    Args:
        to_do: What to measure, see `steps`.
        kinds: The engines.
        family: What the results say that was looked for.
        pace: How long.
    """
    results = Results(this_machine(), family)
    for threads in dict.fromkeys(step.threads for step in to_do):
        works = [step.work for step in to_do if step.threads == threads]
        with Team(kinds, threads, pace.patience) as team:
            team.start(works[0].family)
            for work in works:
                case = work.case()
                rows = scored(case, raced(case, team.members(case), threads, pace), threads)
                results = _with(results, rows)
                yield results


def _with(results: Results, rows: Sequence[Row]) -> Results:
    all_rows = (*results.rows, *rows)
    standard = {setup.name for setup in SETUPS if setup.is_standard}
    return replace(results, rows=all_rows, costs=tuple(costs(all_rows, standard)))

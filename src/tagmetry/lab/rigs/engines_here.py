"""The engines in processes of their own, started once by every process that measures."""

import atexit
from functools import lru_cache
from multiprocessing import current_process

from tagmetry.errors import InputError
from tagmetry.lab.bench.case import Case
from tagmetry.lab.bench.rounds import Pace, raced
from tagmetry.lab.bench.row import Row
from tagmetry.lab.bench.score import scored
from tagmetry.lab.bench.team import Team
from tagmetry.lab.engines import Patience, chosen, installed

_THREADS = 1
_PATIENCE = Patience(image_s=60.0)
_ONCE = Pace(least_rounds=1, most_rounds=1, limit_s=0.0, patience=_PATIENCE)


def engines_here() -> tuple[str, ...]:
    """Return the names of the engines that look at pictures and are installed."""
    return tuple(kind.name for kind in installed() if not kind.tracks)


def judged(case: Case, engines: tuple[str, ...]) -> list[Row]:
    """Return what each engine made of a case's images.

    Raises:
        InputError: An engine is not installed here, or this process may not start others.
    """
    return scored(case, raced(case, _team(engines).members(case), _THREADS, _ONCE), _THREADS)


@lru_cache
def _team(engines: tuple[str, ...]) -> Team:
    """Return the running engines, ended with this process."""
    if current_process().daemon:
        raise InputError(
            "engines run in processes of their own, which this worker may not start: start the "
            "cluster's workers with --no-nanny"
        )
    team = Team(chosen(engines), _THREADS, _PATIENCE)
    atexit.register(team.close)
    return team

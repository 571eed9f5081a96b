"""How far, how fast, how dark: where every detector ends, and how exact it is until there.

Side, distance, tilt, noise, blur, contrast, gamma, motion and light are varied, each by itself.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from tagmetry.lab.bench.render import rendered
from tagmetry.lab.bench.row import Row
from tagmetry.lab.beside.detector_limits import conclude
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.rigs.engines_here import engines_here, judged
from tagmetry.lab.rigs.limit_sweeps import FAMILY, SWEEPS, setup_of
from tagmetry.lab.rows import Limit

_EVERY = 3  # of the values, for a quick look


@dataclass(frozen=True)
class Case:
    """One picture, seen by every engine.

    Attributes:
        variable: What is varied.
        value: To what.
        repeat: Which picture.
        engines: Who looks at it.
    """

    variable: str
    value: float
    repeat: int
    engines: tuple[str, ...]


def cases(quick: bool) -> tuple[Case, ...]:
    """Return every value of everything, each some times with other places and noise."""
    engines = engines_here()
    return tuple(
        Case(variable, value, repeat, engines)
        for variable, sweep in SWEEPS.items()
        for value in sweep.values[:: _EVERY if quick else 1]
        for repeat in range(1 if quick else 4)
    )


def measure(case: Case, seed: int) -> Sequence[Limit]:
    """Return what every engine made of the picture."""
    shown = rendered(setup_of(case.variable, case.value), FAMILY, seed % 2**32)
    return [_limit(case, row) for row in judged(shown, case.engines)]


def _limit(case: Case, row: Row) -> Limit:
    return Limit(
        row.engine,
        case.variable,
        case.value,
        case.repeat,
        row.expected,
        row.found,
        row.false_positives,
        _number(row.corner_rms_px),
        _number(row.bound_px),
        _number(row.distance2),
        _number(row.position_error_percent),
        _number(row.angle_error_deg),
        row.flips or 0,
        row.failure or "",
    )


def _number(value: float | None) -> float:
    return float("nan") if value is None else value


EXPERIMENT = Experiment(
    name="detector-limits",
    title="How far, how fast, how dark: where does every detector end, and how exact is it?",
    source="no paper: every detector that is installed, beside the least error that noise allows",
    row=Limit,
    cases=cases,
    measure=measure,
    conclude=conclude,
)

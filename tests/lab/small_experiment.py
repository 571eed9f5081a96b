"""An experiment that costs nothing, and leaves a trace of every measurement where asked to."""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from tagmetry.errors import InputError
from tagmetry.lab.conclusions import Check, Conclusions
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.sweep import Workers


@dataclass(frozen=True)
class Case:
    name: str
    number: int
    trace: str = ""
    fault: str = ""


@dataclass(frozen=True)
class Row:
    name: str
    number: int
    drawn: float
    process: int
    is_odd: bool


def cases(quick: bool) -> tuple[Case, ...]:
    return tuple(Case(f"case {n}", n) for n in range(2 if quick else 5))


def measure(case: Case, seed: int) -> Sequence[Row]:
    if case.trace:
        (Path(case.trace) / f"{case.number}-{os.getpid()}-{os.urandom(4).hex()}").touch()
    if case.fault == "input":
        raise InputError("the lamp is off")
    if case.fault == "death":
        os._exit(1)
    drawn = np.random.default_rng(seed).standard_normal()
    row = Row(case.name, case.number, drawn, os.getpid(), case.number % 2 == 1)
    return [row, replace(row, drawn=np.nan)]


def conclude(rows: Sequence[Row]) -> Conclusions:
    least = min(row.number for row in rows)
    return Conclusions((Check("a <number>", "0", str(least), least == 0),), remarks=("a & b",))


SMALL = Experiment("small", "Is nothing free?", "no paper", Row, cases, measure, conclude)


def traced(folder: Path, **faults: str) -> Experiment:
    """The small experiment that leaves traces; `fault_2="input"` breaks case 2."""

    def own(quick: bool) -> tuple[Case, ...]:
        return tuple(
            replace(case, trace=str(folder), fault=faults.get(f"fault_{case.number}", ""))
            for case in cases(quick)
        )

    return replace(SMALL, cases=own)


def threads(count: int = 1) -> Workers:
    """Workers that are threads of this process."""
    return Workers(ThreadPoolExecutor(count), count)

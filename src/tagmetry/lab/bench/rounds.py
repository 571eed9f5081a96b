"""Time engines in turn: every round each looks at one image, so that all suffer what one suffers.

With one thread the times are the processor's: what else runs on the computer does not count, and
threads that a library starts nevertheless do. With several they are the clock's.
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass, field

from tagmetry.lab.bench.case import Case
from tagmetry.lab.bench.row import Clock
from tagmetry.lab.bench.setup import Extent
from tagmetry.lab.engines import Answer, Child, EngineKind, Failure, Found, Patience

_WARMING_CYCLES = 2  # of a film, for a tracker to meet every marker


_PATIENCE = Patience(image_s=30.0)


@dataclass(frozen=True)
class Pace:
    """How long to measure.

    Attributes:
        least_rounds: At least so many, however long they take; of pictures that make no film,
            each once.
        most_rounds: At most so many.
        limit_s: After this time of its own an engine has been measured enough on a case.
        patience: An engine that is silent for longer is ended.
    """

    least_rounds: int
    most_rounds: int
    limit_s: float
    patience: Patience = _PATIENCE


PACES: dict[Extent, Pace] = {
    "quick": Pace(least_rounds=2, most_rounds=24, limit_s=0.25),
    "default": Pace(least_rounds=3, most_rounds=50, limit_s=0.6),
    "full": Pace(least_rounds=10, most_rounds=300, limit_s=5.0),
}


@dataclass(eq=False)
class Course:
    """What one engine did on one case so far; grows while it is measured.

    Attributes:
        kind: The engine.
        found: What it found last in each image.
        times_s: Of the images in turn.
        memory_mib: The most it held.
        failure: Why it stopped.
    """

    kind: EngineKind
    found: dict[int, Found] = field(default_factory=dict)
    times_s: list[float] = field(default_factory=list)
    memory_mib: float = 0.0
    failure: Failure | None = None


def raced(case: Case, children: Sequence[Child], threads: int, pace: Pace) -> list[Course]:
    """Return what the engines did on a case, one after the other in every round."""
    courses = {child: Course(child.kind, failure=child.show(case.images)) for child in children}
    for child, course in courses.items():
        _warm(child, course, case)
    least, most = _rounds(case, pace)
    for number in range(most):
        running = [child for child in children if _goes_on(courses[child], least, pace.limit_s)]
        if not running:
            break
        for child in running:
            _round(child, courses[child], number % len(case.images), clock_of(threads))
    return list(courses.values())


def _rounds(case: Case, pace: Pace) -> tuple[int, int]:
    """Return how many rounds there are at least and at most."""
    if case.once:
        return len(case.images), len(case.images)
    least = max(pace.least_rounds, 0 if case.moves else len(case.images))
    return least, max(pace.most_rounds, least)


def clock_of(threads: int) -> Clock:
    """Return what is timed; Windows counts the processor's time in steps that are too coarse."""
    return "processor" if threads == 1 and sys.platform != "win32" else "wall"


def _warm(child: Child, course: Course, case: Case) -> None:
    cycles = _WARMING_CYCLES * len(case.images) if child.kind.tracks else 1
    for number in range(cycles):
        if course.failure is None:
            answer = child.look(number % len(case.images))
            course.failure = answer if isinstance(answer, Failure) else None


def _goes_on(course: Course, least: int, limit_s: float) -> bool:
    enough = len(course.times_s) >= least and sum(course.times_s) >= limit_s
    return course.failure is None and not enough


def _round(child: Child, course: Course, number: int, clock: Clock) -> None:
    answer = child.look(number)
    if isinstance(answer, Answer):
        course.found[number] = answer.found
        course.times_s.append(answer.cpu_s if clock == "processor" else answer.wall_s)
        course.memory_mib = max(course.memory_mib, answer.memory_mib)
    else:
        course.failure = answer

"""Which cases are measured, and with how many threads."""

from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Protocol

from tagmetry.errors import InputError
from tagmetry.lab.bench.case import Case
from tagmetry.lab.bench.hostile import Hostile
from tagmetry.lab.bench.render import rendered
from tagmetry.lab.bench.setup import EXTENTS, Extent, Setup
from tagmetry.lab.bench.setups import SETUPS
from tagmetry.markers import family as family_of


class Work(Protocol):
    """A case before its images are there."""

    @property
    def name(self) -> str:
        """What the case is called."""

    @property
    def family(self) -> str:
        """What to look for."""

    @property
    def all_threads(self) -> bool:
        """It is measured with all threads as well."""

    def case(self) -> Case:
        """Return the case with its images."""


@dataclass(frozen=True)
class Rendering:
    """A rendered case.

    Attributes:
        setup: What to render.
        family: Family of its markers.
    """

    setup: Setup
    family: str

    @property
    def name(self) -> str:
        """What the case is called."""
        return self.setup.name

    @property
    def all_threads(self) -> bool:
        """It is measured with all threads as well."""
        return self.setup.all_threads

    def case(self) -> Case:
        """Return the case with its images."""
        return rendered(self.setup, self.family)


def renderings(extent: Extent, family: str) -> list[Work]:
    """Return the rendered cases of an extent.

    Raises:
        InputError: There is no such family.
    """
    name = family_of(family).name
    wanted = EXTENTS[: EXTENTS.index(extent) + 1]
    works: list[Work] = [Rendering(setup, name) for setup in SETUPS if setup.extent in wanted]
    return [*works, Hostile(name)] if extent == "full" else works


def fitting(works: Sequence[Work], patterns: Sequence[str]) -> list[Work]:
    """Return the cases whose names fit a pattern, such as `side-*`.

    Raises:
        InputError: A pattern fits none.
    """
    for pattern in patterns:
        if not any(fnmatchcase(work.name, pattern) for work in works):
            names = ", ".join(work.name for work in works)
            raise InputError(f"no case is called {pattern!r}; there are {names}")
    return [work for work in works if any(fnmatchcase(work.name, p) for p in patterns)]


@dataclass(frozen=True)
class Step:
    """A case with so many threads.

    Attributes:
        work: The case.
        threads: How many every engine may use.
    """

    work: Work
    threads: int


def steps(works: Sequence[Work], threads: Sequence[int]) -> list[Step]:
    """Return all cases with the first number of threads, and some with the others as well."""
    first, *more = threads
    again = [Step(work, count) for count in more for work in works if work.all_threads]
    return [Step(work, first) for work in works] + again

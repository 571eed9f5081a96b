"""What an experiment is: what it varies, how a case is measured, and what is concluded.

Cases and rows are frozen dataclasses of plain values (text, whole numbers, numbers, yes or no; a
case may hold tuples of them), so that a case has a name of its own and a row is a line of a table.
"""

from collections.abc import Callable, Sequence
from dataclasses import Field, dataclass
from typing import Any, ClassVar, Generic, Protocol, TypeVar

from tagmetry.lab.conclusions import Conclusions


class Record(Protocol):
    """A frozen dataclass of plain values."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


CaseT = TypeVar("CaseT", bound=Record)
RowT = TypeVar("RowT", bound=Record)


@dataclass(frozen=True)
class Experiment(Generic[CaseT, RowT]):
    """A sweep over cases, each measured by itself.

    Attributes:
        name: What it is called on the command line.
        title: What it finds out, in a line.
        source: What was published about it: paper, tables, figures.
        row: What a row of its results is.
        cases: All cases; few of them where True is given, for a quick look.
        measure: The rows of a case, with a seed of the case's own; pure.
        conclude: Tables, figures and checks of the rows of all cases.
    """

    name: str
    title: str
    source: str
    row: type[RowT]
    cases: Callable[[bool], Sequence[CaseT]]
    measure: Callable[[CaseT, int], Sequence[RowT]]
    conclude: Callable[[Sequence[RowT]], Conclusions]

"""What a folder of results says about an experiment."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tagmetry.lab.conclusions import Conclusions
from tagmetry.lab.experiment import Experiment
from tagmetry.lab.registry import experiment, experiment_names
from tagmetry.lab.results import Origin, read_origin, read_rows


@dataclass(frozen=True)
class Chapter:
    """An experiment and its results.

    Attributes:
        experiment: Which.
        origin: How the results came about; None where it was not run.
        conclusions: What they say; nothing where it was not run.
    """

    experiment: Experiment[Any, Any]
    origin: Origin | None = None
    conclusions: Conclusions = field(default_factory=Conclusions)


def chapters(home: Path) -> Iterator[Chapter]:
    """Give a chapter for every experiment there is.

    Raises:
        InputError: A file of results is broken.
    """
    for name in experiment_names():
        yield chapter(experiment(name), home)


def chapter(about: Experiment[Any, Any], home: Path) -> Chapter:
    """Return an experiment's chapter."""
    path = home / f"{about.name}.parquet"
    if not path.exists():
        return Chapter(about)
    origin = read_origin(path)
    return Chapter(about, origin, about.conclude(read_rows(path, about.row)))

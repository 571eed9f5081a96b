"""Where a sweep's results are: a file for every finished case, and one of all in the end."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from pathlib import Path
from typing import Any

from tagmetry import __version__
from tagmetry.errors import InputError
from tagmetry.lab.experiment import Experiment, Record
from tagmetry.lab.results import Origin, read_rows, write_rows
from tagmetry.lab.sweep.name import case_name, settings_json


@dataclass(frozen=True)
class Sweep:
    """An experiment's cases, and the folder of its results.

    Attributes:
        experiment: What is measured.
        home: Folder of all results.
        seed: Of the run.
        quick: Only few cases.
    """

    experiment: Experiment[Any, Any]
    home: Path
    seed: int = 0
    quick: bool = False

    @cached_property
    def cases(self) -> tuple[Any, ...]:
        """All cases."""
        return tuple(self.experiment.cases(self.quick))

    @property
    def result(self) -> Path:
        """The file of all rows."""
        return self.home / f"{self.experiment.name}.parquet"

    def unfinished(self) -> tuple[Any, ...]:
        """Return the cases that are still to be measured."""
        return tuple(case for case in self.cases if not self._file(case).exists())

    def keep(self, case: Record, rows: Sequence[Record]) -> None:
        """Keep a finished case's rows."""
        make_folder(self._file(case).parent)
        self._write(self._file(case), rows, (case,))

    def gather(self) -> Path:
        """Write one file of all cases, and return it.

        Raises:
            InputError: A case's file is broken.
        """
        parts = (read_rows(self._file(case), self.experiment.row) for case in self.cases)
        self._write(self.result, list(chain.from_iterable(parts)), self.cases)
        return self.result

    def _file(self, case: Record) -> Path:
        name = case_name(self.experiment, case, self.seed)
        return self.home / "cases" / self.experiment.name / f"{name}.parquet"

    def _write(self, path: Path, rows: Sequence[Record], cases: tuple[Record, ...]) -> None:
        settings = tuple(map(settings_json, cases))
        origin = Origin(self.experiment.name, __version__, self.seed, self.quick, settings)
        write_rows(path, rows, self.experiment.row, origin)


def make_folder(folder: Path) -> None:
    """Make a folder where there is none.

    Raises:
        InputError: It cannot be made there.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make the folder {folder}: {error.strerror}") from error

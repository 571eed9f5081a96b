"""The result of a bench, as a value and as a file."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from tagmetry.errors import InputError
from tagmetry.files.atomic import write_atomically
from tagmetry.files.json_text import parse_json
from tagmetry.lab.bench.costs import Cost
from tagmetry.lab.bench.machine import Machine
from tagmetry.lab.bench.row import Row


@dataclass(frozen=True)
class Results:
    """All that was measured in one run.

    Attributes:
        machine: Where.
        family: What was looked for in rendered pictures and the user's own.
        rows: One per case, engine and number of threads.
        costs: What an image and a marker cost.
    """

    machine: Machine
    family: str
    rows: tuple[Row, ...] = ()
    costs: tuple[Cost, ...] = ()

    def of(self, case: str, engine: str, threads: int) -> Row | None:
        """Return a row, None where there is none."""
        wanted = (case, engine, threads)
        return next((r for r in self.rows if (r.case, r.engine, r.threads) == wanted), None)


def save_results(results: Results, path: Path) -> None:
    """Write results as JSON, whole or not at all."""
    write_atomically(path, json.dumps(asdict(results), indent=1, allow_nan=False) + "\n")


def load_results(path: Path) -> Results:
    """Read what `save_results` wrote.

    Raises:
        InputError: The file cannot be read, or holds something else.
    """
    try:
        content = parse_json(path.read_text("utf-8"))
        return TypeAdapter(Results).validate_python(content)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: expected JSON in UTF-8, found other bytes") from error
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"])) or "the whole"
        raise InputError(
            f"{path} is no result of `tagmetry bench`: {where}: {first['msg']}"
        ) from error
    except InputError as error:
        raise InputError(f"{path}: {error}") from error

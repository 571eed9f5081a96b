"""Rows of results as Parquet, with how they came about in the file's metadata."""

import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, TypeVar

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.files.atomic import replace_file
from tagmetry.lab.experiment import Record

_KEY = b"tagmetry"
RowT = TypeVar("RowT", bound=Record)


@dataclass(frozen=True)
class Origin:
    """How rows came about.

    Attributes:
        experiment: Its name.
        version: Of the software.
        seed: Of the run.
        quick: Whether only few cases were measured.
        settings: Every case's settings, as JSON.
    """

    experiment: str
    version: str
    seed: int
    quick: bool
    settings: tuple[str, ...]


def require_parquet() -> None:
    """Raise MissingExtraError unless results can be written and read."""
    try:
        import pyarrow as pa  # noqa: F401
    except ImportError as error:
        raise MissingExtraError("results of the laboratory", "parquet") from error


def write_rows(path: Path, rows: Sequence[Record], kind: type[Record], origin: Origin) -> None:
    """Write rows to a file, which appears whole or not at all.

    Raises:
        InputError: It cannot be written there, or the disk is full.
        MissingExtraError: pyarrow is not installed.
    """
    require_parquet()
    import pyarrow as pa
    from pyarrow.parquet import write_table

    columns = {field.name: [getattr(row, field.name) for row in rows] for field in fields(kind)}
    table = pa.table(columns, schema=_schema(kind, origin))
    try:
        with replace_file(path) as file:
            write_table(table, file, compression="zstd")
    except OSError as error:
        raise InputError(
            f"cannot write {path}: {error.strerror or error}; what is finished is kept, and the "
            f"same command goes on from there"
        ) from error


def read_origin(path: Path) -> Origin:
    """Return how a file's rows came about.

    Raises:
        InputError: The file is no result of the laboratory.
    """
    require_parquet()
    import pyarrow as pa
    from pyarrow.parquet import read_schema

    try:
        told = (read_schema(path).metadata or {})[_KEY]
        table = json.loads(told)
        return Origin(**{**table, "settings": tuple(table["settings"])})
    except (pa.ArrowException, OSError, KeyError, TypeError, ValueError) as error:
        raise _broken(path, error) from error


def read_rows(path: Path, kind: type[RowT]) -> list[RowT]:
    """Return the rows of a file.

    Raises:
        InputError: The file is no result of the laboratory, or of another experiment.
    """
    require_parquet()
    import pyarrow as pa
    from pyarrow.parquet import read_table

    try:
        table = read_table(path, columns=[field.name for field in fields(kind)])
        return [_row(kind, record) for record in table.to_pylist()]
    except (pa.ArrowException, OSError, TypeError, ValueError) as error:
        raise _broken(path, error) from error


def _row(kind: type[RowT], record: dict[str, Any]) -> RowT:
    if any(value is None for value in record.values()):
        raise ValueError("a value is missing")
    return kind(**record)


def _schema(kind: type[Record], origin: Origin) -> Any:  # noqa: ANN401 (pyarrow has no types)
    import pyarrow as pa

    types = {"str": pa.string(), "int": pa.int64(), "float": pa.float64(), "bool": pa.bool_()}
    columns = [(field.name, types[_type_name(field.type)]) for field in fields(kind)]
    return pa.schema(columns, metadata={_KEY: json.dumps(asdict(origin))})


def _type_name(type_: type[Any] | str | Any) -> str:  # noqa: ANN401 (what a field's type is)
    return type_ if isinstance(type_, str) else str(type_.__name__)


def _broken(path: Path, error: Exception) -> InputError:
    if isinstance(error, FileNotFoundError):
        return InputError(f"{path}: there is no such result of the laboratory; run the experiment")
    why = " ".join(str(error).split())[:120]
    return InputError(
        f"{path}: no whole result of the laboratory ({why}); delete it and run the experiment again"
    )

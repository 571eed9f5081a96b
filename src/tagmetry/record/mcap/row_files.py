"""Rows into CSV and Parquet files."""

import csv
import io
from collections.abc import Mapping
from contextlib import ExitStack
from typing import BinaryIO

from tagmetry.errors import MissingExtraError
from tagmetry.record.mcap.rows import Cell, ColumnType

_BATCH_ROWS = 10_000


class CsvRows:
    """Writes rows as comma-separated values with a header."""

    def __init__(self, columns: Mapping[str, ColumnType]) -> None:
        self._columns = columns

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:
        """Write the header."""
        text = io.TextIOWrapper(file, encoding="utf-8", newline="")
        stack.callback(text.detach)
        self._rows = csv.writer(text, lineterminator="\n")
        self._rows.writerow(self._columns)

    def write(self, item: list[Cell]) -> None:
        """Write one row; what is not known is an empty cell."""
        self._rows.writerow([_known(cell) for cell in item])

    def finish(self) -> None:
        """Nothing comes last."""


class ParquetRows:
    """Writes rows to a Parquet file, many at a time."""

    def __init__(self, columns: Mapping[str, ColumnType]) -> None:
        self._columns = columns
        self._waiting: list[dict[str, Cell]] = []

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:
        """Write the schema.

        Raises:
            MissingExtraError: The part `parquet` is not installed.
        """
        try:
            import pyarrow as pa
            from pyarrow.parquet import ParquetWriter
        except ImportError as error:
            raise MissingExtraError("writing Parquet", "parquet") from error
        types = {"bool": pa.bool_(), "string": pa.string()}
        types |= {"int64": pa.int64(), "float64": pa.float64()}
        schema = pa.schema([(name, types[kind]) for name, kind in self._columns.items()])
        self._writer = stack.enter_context(ParquetWriter(file, schema, compression="zstd"))

    def write(self, item: list[Cell]) -> None:
        """Take one row."""
        self._waiting.append(dict(zip(self._columns, item, strict=True)))
        if len(self._waiting) == _BATCH_ROWS:
            self.finish()

    def finish(self) -> None:
        """Write the rows that still wait."""
        import pyarrow as pa

        table = pa.Table.from_pylist(self._waiting, schema=self._writer.schema)
        self._writer.write_table(table)
        self._waiting = []


def _known(cell: Cell) -> Cell:
    if isinstance(cell, bool):
        return int(cell)
    return "" if cell != cell else cell  # noqa: PLR0124 (NaN alone differs from itself)

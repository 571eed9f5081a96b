"""Parquet: one row for every image, with the markers and their poses nested as in the contract."""

from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from pydantic import ValidationError

from tagmetry import __version__
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.record.line import ImageLine, first_complaint
from tagmetry.record.result import ImageResult
from tagmetry.record.told import from_line, to_line

if TYPE_CHECKING:
    import pyarrow as pa

BATCH_IMAGES = 256  # images that wait in memory before they are written


class ParquetEncoder:
    """Writes results to a Parquet file, a batch of images at a time."""

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:
        """Write the schema."""
        schema = _schema()
        from pyarrow.parquet import ParquetWriter

        self._writer = stack.enter_context(ParquetWriter(file, schema, compression="zstd"))
        self._waiting: list[dict[str, object]] = []

    def write(self, item: ImageResult) -> None:
        """Take one image."""
        self._waiting.append(to_line(item).model_dump())
        if len(self._waiting) == BATCH_IMAGES:
            self.finish()

    def finish(self) -> None:
        """Write the images that still wait."""
        import pyarrow as pa

        self._writer.write_table(pa.Table.from_pylist(self._waiting, schema=self._writer.schema))
        self._waiting = []


def read_parquet(path: Path) -> Iterator[ImageResult]:
    """Give the results of a file, one by one.

    Raises:
        InputError: The file is no Parquet file, or not one of ours; the text names the column.
    """
    _require_pyarrow("reading Parquet")
    import pyarrow as pa
    from pyarrow.parquet import ParquetFile

    with path.open("rb") as file:
        try:
            for batch in ParquetFile(file).iter_batches(BATCH_IMAGES):
                yield from map(_parse_row, batch.to_pylist())
        except (pa.ArrowException, OSError) as error:
            raise InputError(f"{path}: no readable Parquet file: {error}") from error
        except InputError as error:
            raise InputError(f"{path}: {error}") from None


def _parse_row(row: dict[str, object]) -> ImageResult:
    try:
        return from_line(ImageLine.model_validate(row))
    except ValidationError as error:
        raise InputError(first_complaint(error)) from None


def _require_pyarrow(purpose: str) -> None:
    try:
        import pyarrow as pa  # noqa: F401
    except ImportError as error:
        raise MissingExtraError(purpose, "parquet") from error


def _schema() -> "pa.Schema":
    _require_pyarrow("writing Parquet")
    import pyarrow as pa

    fields = [
        ("source", pa.string()),
        ("sequence", pa.int64()),
        ("time_s", pa.float64()),
        ("time_kind", pa.string()),
        ("width", pa.int32()),
        ("height", pa.int32()),
        ("markers", pa.list_(_marker_type())),
    ]
    return pa.schema(fields, metadata={"tagmetry": __version__, "poses": "T_camera_marker"})


def _marker_type() -> "pa.DataType":
    import pyarrow as pa

    return pa.struct(
        [
            ("family", pa.string()),
            ("id", pa.int64()),
            ("corners_px", pa.list_(pa.list_(pa.float64()))),
            ("corners_cov_px2", pa.list_(pa.list_(pa.float64()))),
            ("hamming", pa.int64()),
            ("confidence", pa.float64()),
            ("is_inverted", pa.bool_()),
            ("touches_border", pa.bool_()),
            ("is_duplicate", pa.bool_()),
            ("size_m", pa.float64()),
            ("poses", pa.list_(_pose_type())),
        ]
    )


def _pose_type() -> "pa.DataType":
    import pyarrow as pa

    return pa.struct(
        [
            ("rotation_xyzw", pa.list_(pa.float64())),
            ("translation_m", pa.list_(pa.float64())),
            ("covariance", pa.list_(pa.list_(pa.float64()))),
            ("reprojection_rms_px", pa.float64()),
            ("probability", pa.float64()),
            ("chi2", pa.float64()),
        ]
    )

"""A matrix as camera files spell it, and the intrinsics that it holds."""

from typing import Any, Self

import numpy as np
from pydantic import model_validator

from tagmetry.errors import InputError
from tagmetry.files.checked import FileModel
from tagmetry.geometry.arrays import Array


class Matrix(FileModel):
    """Rows, columns and the numbers row by row; lists and lists of lists are understood too."""

    rows: int
    cols: int
    data: list[float]

    @model_validator(mode="before")
    @classmethod
    def _from_lists(cls, value: Any) -> Any:  # noqa: ANN401
        if not isinstance(value, list):
            return value
        rows = [row if isinstance(row, list) else [row] for row in value]
        columns = len(rows[0]) if rows else 1
        if any(len(row) != columns for row in rows):
            raise ValueError("the rows differ in length")
        return {"rows": len(rows), "cols": columns, "data": [x for row in rows for x in row]}

    @model_validator(mode="after")
    def _check_count(self) -> Self:
        if self.rows < 0 or self.cols < 0 or self.rows * self.cols != len(self.data):
            raise ValueError(
                f"expected rows * cols = {self.rows} * {self.cols} numbers, found {len(self.data)}"
            )
        return self


def intrinsics(matrix: Matrix) -> Array:
    """Return K = [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] of a camera matrix, shape (3, 3), pixels."""
    if (matrix.rows, matrix.cols) != (3, 3):
        raise InputError(f"expected a 3x3 camera matrix, found {matrix.rows}x{matrix.cols}")
    K = np.array(matrix.data, dtype=np.float64).reshape(3, 3)
    if K[0, 1] != 0:
        raise InputError(
            f"the camera matrix has a skew of {K[0, 1]} px; this camera model has none: calibrate "
            "without skew"
        )
    if K[1, 0] != 0 or not np.array_equal(K[2], [0.0, 0.0, 1.0]):
        raise InputError(
            f"expected a camera matrix [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], found {K.tolist()}"
        )
    return K


def coefficients(matrix: Matrix) -> tuple[float, ...]:
    """Return the numbers of a single row or column."""
    if matrix.data and 1 not in (matrix.rows, matrix.cols):
        raise InputError(
            f"expected one row of distortion coefficients, found {matrix.rows}x{matrix.cols}"
        )
    return tuple(matrix.data)

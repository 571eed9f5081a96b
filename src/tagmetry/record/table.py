"""CSV: one row for every marker, for spreadsheets and plots.

An image without markers has no row. What is not known is an empty cell. Of the covariance the table
holds the standard deviations; the other formats hold all of it.
"""

import csv
import io
from collections.abc import Iterator
from contextlib import ExitStack
from typing import BinaryIO

import numpy as np

from tagmetry.pose.result import MarkerPose
from tagmetry.record.line import printable
from tagmetry.record.result import ImageResult, MarkerResult
from tagmetry.record.told import quaternion_xyzw

IMAGE_COLUMNS = ("source", "sequence", "time_s", "time_kind", "width_px", "height_px")
MARKER_COLUMNS = (
    *("family", "id"),
    *("x0_px", "y0_px", "x1_px", "y1_px", "x2_px", "y2_px", "x3_px", "y3_px"),
    *("hamming", "confidence", "is_inverted", "touches_border", "is_duplicate"),
)
POSE_COLUMNS = (
    "size_m",
    *("x_m", "y_m", "z_m", "qx", "qy", "qz", "qw"),
    *("sd_x_m", "sd_y_m", "sd_z_m", "sd_rx_rad", "sd_ry_rad", "sd_rz_rad"),
    *("reprojection_rms_px", "probability", "ambiguity"),
)
COLUMNS = IMAGE_COLUMNS + MARKER_COLUMNS + POSE_COLUMNS

Cell = str | int | float


class TableEncoder:
    """Writes results as comma-separated values with a header."""

    def begin(self, file: BinaryIO, stack: ExitStack) -> None:
        """Write the header."""
        text = io.TextIOWrapper(file, encoding="utf-8", newline="")
        stack.callback(text.detach)
        self._rows = csv.writer(text, lineterminator="\n")
        self._rows.writerow(COLUMNS)

    def write(self, item: ImageResult) -> None:
        """Write one row per marker."""
        self._rows.writerows(table_rows(item))

    def finish(self) -> None:
        """Nothing comes last."""


def table_rows(result: ImageResult) -> Iterator[list[Cell]]:
    """Give the rows of an image, in the order of `COLUMNS`."""
    image: list[Cell] = [
        printable(result.source),
        result.sequence,
        result.time_s,
        result.time_kind,
        result.width_px,
        result.height_px,
    ]
    for marker in result.markers:
        cells = image + _marker_cells(marker) + _pose_cells(marker.pose)
        yield [_known(cell) for cell in cells]


def _marker_cells(marker: MarkerResult) -> list[Cell]:
    seen = marker.detection
    flags = [int(seen.is_inverted), int(seen.touches_border), int(seen.is_duplicate)]
    corners: list[float] = seen.corners_px.ravel().tolist()
    return [seen.family, int(seen.id), *corners, int(seen.hamming), float(seen.confidence), *flags]


def _pose_cells(pose: MarkerPose | None) -> list[Cell]:
    if pose is None:
        return [""] * len(POSE_COLUMNS)
    if not pose.hypotheses:
        return [float(pose.size_m)] + [""] * (len(POSE_COLUMNS) - 1)
    best = pose.best
    numbers = np.concatenate(
        [
            [pose.size_m],
            best.T_camera_marker.translation,
            quaternion_xyzw(best.T_camera_marker),
            np.sqrt(np.clip(np.diag(best.covariance), 0.0, None)),
            [best.reprojection_rms_px, best.probability, pose.ambiguity],
        ]
    )
    return list(numbers.tolist())


def _known(cell: Cell) -> Cell:
    return "" if isinstance(cell, float) and not np.isfinite(cell) else cell

"""What a finished session leaves: the camera, its report, and both as files with a checked name."""

import datetime as dt
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tagmetry import __version__
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.files import save_camera
from tagmetry.files.atomic import write_atomically
from tagmetry.files.board_text import board_text
from tagmetry.markers import Board
from tagmetry.pipeline.board_pictures import Sighting
from tagmetry.pipeline.calibration import (
    CalibrationRun,
    Request,
    run_calibration,
    with_provenance,
)
from tagmetry.record.calibration_report.page import page

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,39}", re.ASCII)


@dataclass(frozen=True, eq=False)
class Solved:
    """A camera that was calibrated.

    Attributes:
        run: The calibration with all that belongs to it.
        report: The page that `tagmetry calibrate --report` writes; None without matplotlib.
    """

    run: CalibrationRun
    report: str | None

    def save(self, folder: Path, name: str) -> None:
        """Write the camera's file, and the report beside it where there is one.

        Raises:
            InputError: The name is none, is taken, or nothing can be written there.
        """
        camera, report = (folder / f"{checked_name(name)}{suffix}" for suffix in (".yaml", ".html"))
        for path in (camera, report):
            if path.exists() or path.is_symlink():
                raise InputError(f"there is {path.name} already; choose another name")
        folder.mkdir(parents=True, exist_ok=True)
        save_camera(self.run.calibration.camera, camera)
        if self.report is not None:
            write_atomically(report, self.report)


def solved(seen: Sequence[Sighting], board: Board) -> Solved:
    """Return the camera that a session's views give.

    Raises:
        InputError: They give none; it says why.
    """
    run = run_calibration(seen, Request(board))
    today = dt.datetime.now(tz=dt.UTC).date().isoformat()
    run = with_provenance(run, board_text(board), f"tagmetry {__version__}", today)
    try:
        return Solved(run, page(run.facts))
    except MissingExtraError:
        return Solved(run, None)


def checked_name(name: str) -> str:
    """Return the name of a camera's file.

    Raises:
        InputError: It is no plain name.
    """
    if not _NAME.fullmatch(name):
        raise InputError(
            "expected a name of 1 to 40 letters, digits, - and _, without a suffix, "
            f"found {name[:40]!r}"
        )
    return name

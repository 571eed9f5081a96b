"""The calibration room: begins, ends and saves what operators ask for; everybody may watch."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import cast

from fastapi import Request, Response

from tagmetry.errors import InputError
from tagmetry.files.board_text import parse_board
from tagmetry.live.messages import Asked, Told
from tagmetry.live.rooms.calibrate.capture import Capture, Wanted
from tagmetry.live.rooms.calibrate.messages import (
    EndCalibration,
    SaveCalibration,
    StartCalibration,
)
from tagmetry.live.rooms.calibrate.solved import Solved, checked_name
from tagmetry.live.rooms.only import OnlyWork
from tagmetry.live.rooms.room import Room, words
from tagmetry.pipeline.guided import checked_uncertainty_px

_MOST_CORNERS = 1500


def calibrate_room(give: Callable[[Told], None], camera: str, folder: Path) -> Room:
    """Return the room.

    Args:
        give: Takes every message for the pages, from any thread.
        camera: That is calibrated: `twin`, or as `tagmetry.pipeline.open_images` understands it.
        folder: For cameras' files and reports.
    """
    desk = _Desk(give, camera, folder)
    return Room(
        answers={"/calibrate/report": desk.report},
        takers={
            StartCalibration: desk.start,
            EndCalibration: desk.end,
            SaveCalibration: desk.save,
        },
        close=desk.close,
    )


class _Desk:
    """Knows the one calibration that runs, or ran last."""

    def __init__(self, give: Callable[[Told], None], camera: str, folder: Path) -> None:
        self._give, self._camera, self._folder = give, camera, folder
        self._capture: OnlyWork[Capture] = OnlyWork(
            runs="a calibration runs already; end it first", rests="no calibration runs"
        )
        self._writer = ThreadPoolExecutor(1, "calibration files")

    def start(self, asked: Asked) -> None:
        """Begin a calibration."""
        wanted = self._wanted(cast("StartCalibration", asked))
        self._capture.begin(lambda: Capture(wanted, self._give))

    def end(self, _: Asked) -> None:
        """Take no more views."""
        self._capture.end()

    def save(self, asked: Asked) -> None:
        """Write the camera into the folder, beside the server's loop."""
        name = checked_name(cast("SaveCalibration", asked).name)
        capture = self._capture.newest
        if capture is None or capture.solved is None:
            raise InputError("there is no camera to save yet")
        self._writer.submit(self._written, capture, capture.solved, name)

    async def report(self, _: Request) -> Response:
        """Return the report of the newest camera, as a file: its styles are its own."""
        capture = self._capture.newest
        solved = capture.solved if capture is not None else None
        if solved is None or solved.report is None:
            return words("there is no report yet", 409)
        disposition = {"content-disposition": 'attachment; filename="calibration.html"'}
        return Response(solved.report, media_type="text/html", headers=disposition)

    def close(self) -> None:
        """End what runs."""
        self._capture.close()
        self._writer.shutdown()

    def _wanted(self, asked: StartCalibration) -> Wanted:
        board = parse_board(asked.board)
        if len(board.corners_m) > _MOST_CORNERS:
            raise InputError(
                f"the page follows boards of up to {_MOST_CORNERS} corners, "
                f"got {len(board.corners_m)}"
            )
        return Wanted(self._camera, board, checked_uncertainty_px(asked.uncertainty))

    def _written(self, capture: Capture, solved: Solved, name: str) -> None:
        try:
            solved.save(self._folder, name)
        except (InputError, OSError) as error:
            capture.tell(why=str(error))
        else:
            capture.tell(saved=name, why="")

"""One guided calibration in a thread of its own: images, views, the camera.

It rests as long as it works, so that the robots' thread keeps at least half of a processor.
"""

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.files.board_text import board_text
from tagmetry.live.rooms.calibrate.cameras import Watched, opened_camera
from tagmetry.live.rooms.calibrate.messages import CalibrationPicture, CalibrationState
from tagmetry.live.rooms.calibrate.solved import Solved, solved
from tagmetry.live.rooms.calibrate.told import told_coverage, told_picture, told_result
from tagmetry.live.rooms.work import Work
from tagmetry.markers import Board
from tagmetry.pipeline.board_pictures import Sighting
from tagmetry.pipeline.guided import Step, guided

_MOST_S = 900.0  # then it solves from what it has
_PICTURE_S = 0.2
_LEAST_VIEWS = 3

Give = Callable[[CalibrationState | CalibrationPicture], None]


@dataclass(frozen=True)
class Wanted:
    """What is to be calibrated.

    Attributes:
        camera: `twin`, or a camera as `tagmetry.pipeline.open_images` understands it.
        board: What is held before it.
        uncertainty_px: To be reached at the worst place of the image.
    """

    camera: str
    board: Board
    uncertainty_px: float


class Capture(Work):
    """A calibration that runs.

    Attributes:
        state: What the page was told last.
        solved: The camera; None before it is solved.
    """

    def __init__(self, wanted: Wanted, give: Give) -> None:
        """Begin.

        Args:
            wanted: What is to be calibrated.
            give: Takes what the page is told, in the capture's thread.
        """
        self._wanted, self._give = wanted, give
        self.solved: Solved | None = None
        self.state = CalibrationState(
            "looking", wanted.camera, board_text(wanted.board), wanted.uncertainty_px
        )
        self._enough = threading.Event()
        self._pictured_s = float("-inf")
        self._lost = ""  # why images ended before there were enough
        super().__init__("calibration")

    def end(self) -> None:
        """Take no more views; the thread then solves."""
        self._enough.set()

    def close(self, patience_s: float = 5.0) -> None:
        """End without a camera, and wait a little for it."""
        self._is_ending.set()
        super().close(patience_s)

    def tell(self, **changed: object) -> None:
        """Tell the page what has changed."""
        self.state = replace(self.state, **changed)  # type: ignore[arg-type]
        self._give(self.state)

    def _run(self) -> None:
        try:
            taken = self._looked()
            if not self._is_ending.is_set():
                self._solve(taken)
        except (InputError, OSError) as error:
            self.tell(phase="failed", why=str(error), advice="")

    def _looked(self) -> list[Sighting]:
        """Return the views that were taken."""
        self.tell(advice="the camera is being opened")
        watched, taken = opened_camera(self._wanted.camera, self._wanted.board), []
        try:
            for image, step in self._steps(watched):
                taken += [step.taken] if step.taken is not None else []
                self._tell_step(image, step)
                watched.follow(step.session)
        finally:
            watched.close()
        return taken

    def _steps(self, watched: Watched) -> Iterator[tuple[Image, Step]]:
        """Give images with what each did, until there are enough."""
        newest: list[Image] = []

        def remembered() -> Iterator[Image]:
            for image in self._until_lost(watched):
                newest[:] = [image]
                yield image

        began_s, worked_s = time.monotonic(), time.thread_time()
        for step in guided(remembered(), self._wanted.board, self._wanted.uncertainty_px):
            yield newest[0], step
            cost_s = time.thread_time() - worked_s
            if self._enough.wait(cost_s) or time.monotonic() - began_s > _MOST_S:
                return
            worked_s = time.thread_time()

    def _until_lost(self, watched: Watched) -> Iterator[Image]:
        """Give the camera's images; where they end, what was seen until then is kept."""
        try:
            yield from watched.images()
            self._lost = "the camera gives no more images"
        except (InputError, OSError) as error:
            self._lost = f"the camera was lost: {error}"

    def _tell_step(self, image: Image, step: Step) -> None:
        session = step.session
        if step.taken is not None or time.monotonic() - self._pictured_s >= _PICTURE_S:
            self._pictured_s = time.monotonic()
            self._give(told_picture(image, session))
        self.tell(
            advice=session.next.text,
            why=session.outcome.reason,
            uncertainty_px=session.uncertainty_px,
            coverage=told_coverage(session),
        )

    def _solve(self, taken: list[Sighting]) -> None:
        if len(taken) < _LEAST_VIEWS:
            needs = f"a camera needs at least {_LEAST_VIEWS} views, {len(taken)} were taken"
            raise InputError("; ".join(filter(None, (self._lost, needs))))
        self.tell(
            phase="solving", advice="the camera is being solved from all views", why=self._lost
        )
        self.solved = solved(taken, self._wanted.board)
        result = told_result(self.solved.run, has_report=self.solved.report is not None)
        self.tell(phase="done", advice="", result=result)

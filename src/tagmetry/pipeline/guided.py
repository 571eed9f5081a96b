"""A guided calibration on a running source: images in, the state of the session out."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from tagmetry.calibrate.guidance import Plan, Session
from tagmetry.calibrate.targets import explain_board
from tagmetry.calibrate.view import BoardView, RejectedView
from tagmetry.camera import Image
from tagmetry.errors import InputError
from tagmetry.geometry.arrays import AnyPixels, GreyPixels
from tagmetry.markers import Board
from tagmetry.pipeline.board_pictures import Sighting, thumbnail

_STILL_S = 1 / 30  # between pictures that have no time


@dataclass(frozen=True, eq=False)
class Step:
    """What one image did.

    Attributes:
        session: The session after it.
        taken: The view with its thumbnail, where the session took it.
    """

    session: Session
    taken: Sighting | None = None


def guided(images: Iterable[Image], board: Board, wanted_px: float) -> Iterator[Step]:
    """Give a session's steps until it is finished or the images end.

    Args:
        images: Of a camera or a video, with their times.
        board: What is held before the camera.
        wanted_px: Largest standard deviation of projections over the image to be reached.

    Raises:
        InputError: The images change their size, or the board fits nowhere into them.
    """
    session: Session | None = None
    for image in images:
        if session is None:
            plan = Plan(board, (image.width_px, image.height_px), wanted_px)
            session = Session.begin(plan)
        step = _stepped(session, image)
        yield step
        session = step.session
        if session.finished is not None:
            return


def finished_sightings(steps: Iterable[Sighting], last: AnyPixels | None) -> tuple[Sighting, ...]:
    """Return the views taken; where there are none, the last image, for the doctor."""
    taken = tuple(steps)
    if taken or last is None:
        return taken
    nothing = RejectedView("", "the board was never seen still and sharp")
    return (Sighting(nothing, np.zeros((0, 0), np.uint8), pixels=last),)


def _stepped(session: Session, image: Image) -> Step:
    place = f"{image.source} [{image.sequence}]"
    found = explain_board(image.pixels, session.plan.board, source=place, thorough=False)
    time_s = image.sequence * _STILL_S if image.time_kind == "none" else image.time_s
    if not isinstance(found.result, BoardView):
        return Step(session.step(found.result.reason, time_s))
    after = session.step(found.result, time_s, found.quality)
    if not after.outcome.taken:
        return Step(after)
    small: GreyPixels = thumbnail(image.pixels)
    return Step(after, Sighting(found.result, small, found.patches, image.pixels))


def checked_uncertainty_px(text: str) -> float:
    """Return an uncertainty like `0.3px` in pixels.

    Raises:
        InputError: It is none.
    """
    number = text.strip().removesuffix("px").strip()
    try:
        value = float(number)
    except ValueError:
        value = np.nan
    if not (np.isfinite(value) and value > 0):
        raise InputError(f"expected an uncertainty above 0 like 0.3px, found {text[:40]!r}")
    return value

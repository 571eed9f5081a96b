"""`tagmetry calibrate --live`: says where to hold the board, and takes views by itself."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import typer

from tagmetry.errors import InputError

if TYPE_CHECKING:
    from tagmetry.calibrate.guidance import Session
    from tagmetry.camera import Image
    from tagmetry.markers import Board
    from tagmetry.pipeline.board_pictures import Sighting
    from tagmetry.pipeline.guided import Step


def watched(
    sources: list[str], board: "Board", uncertainty: str, *, quiet: bool
) -> "tuple[Sighting, ...]":
    """Return the views that were taken; a Ctrl-C ends the taking, a second one the program.

    Args:
        sources: One camera, stream or video.
        board: The board.
        uncertainty: To be reached, like `0.3px`.
        quiet: Say nothing while it runs.
    """
    from tagmetry.pipeline.guided import checked_uncertainty_px, finished_sightings

    wanted_px = checked_uncertainty_px(uncertainty)
    if len(sources) != 1:
        raise InputError(f"--live watches one source, got {len(sources)}")
    teller, last, taken = _Teller(quiet), None, []
    try:
        for image, step in _steps(sources[0], board, wanted_px):
            last = image.pixels
            taken += [step.taken] if step.taken is not None else []
            teller.tell(step)
    except KeyboardInterrupt:
        if len(taken) < 3:
            raise
        typer.echo(f"ended by hand after {len(taken)} views", err=True)
    return finished_sightings(taken, last)


def _steps(spec: str, board: "Board", wanted_px: float) -> "Iterator[tuple[Image, Step]]":
    """Give images with what each did."""
    from tagmetry.cli.live_state import StateTeller
    from tagmetry.pipeline import open_images
    from tagmetry.pipeline.guided import guided

    newest: list[Image] = []

    def remembered(images: "Iterator[Image]") -> "Iterator[Image]":
        for image in images:
            newest[:] = [image]
            yield image

    with open_images(spec, on_state=StateTeller(spec)) as source:
        for step in guided(remembered(iter(source)), board, wanted_px):
            yield newest[0], step


class _Teller:
    """Says what changed."""

    def __init__(self, quiet: bool) -> None:
        self._quiet, self._text, self._reason = quiet, "", ""

    def tell(self, step: "Step") -> None:
        """Tell the instruction when it changes, every view taken, and why none is."""
        session = step.session
        if self._quiet:
            return
        if step.taken is not None:
            typer.echo(_taken_line(session))
        self._why_not(session)
        if session.next.text != self._text:
            self._text = session.next.text
            typer.echo(f"-> {self._text}")
        if session.finished is not None:
            typer.echo(session.finished)

    def _why_not(self, session: "Session") -> None:
        """Tell a reason when it is of another kind than the last one."""
        kind = session.outcome.reason.partition(":")[0].rstrip("0123456789. ")
        if kind != self._reason and kind:
            typer.echo(f"   {session.outcome.reason}")
        self._reason = kind


def _taken_line(session: "Session") -> str:
    covered = float((session.coverage > 0).mean())
    return (
        f"view {len(session.taken)} taken: {session.uncertainty_px[-1]:.2f} px at the worst place, "
        f"corners in {covered:.0%} of the picture"
    )

"""`tagmetry lens bank`: a guided calibration at every focus value that is still missing."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from tagmetry.calibrate.view import BoardView
    from tagmetry.camera import Image
    from tagmetry.markers import Board


def calibrated_bank(
    camera: str, board: str, out: Path, step: float, uncertainty: str, name: str
) -> None:
    """Calibrate and keep, focus by focus; what is in the file already is not made again."""
    from tagmetry.files import load_bank, save_bank
    from tagmetry.files.board_text import parse_board
    from tagmetry.pipeline.guided import checked_uncertainty_px
    from tagmetry.pipeline.lens.bank import calibrate_bank, missing_foci
    from tagmetry.pipeline.lens.opened import opened

    wanted_px, held = checked_uncertainty_px(uncertainty), parse_board(board)
    bank = load_bank(out) if out.exists() else None
    with opened(camera) as source:
        todo = missing_foci(bank, source.controls.available["focus"], step)
        typer.echo(
            f"{len(todo)} focus values to calibrate, from {todo[0]:g} on" if todo else "done"
        )

        def views(images: "Iterator[Image]") -> "Sequence[BoardView]":
            return _guided_views(images, held, wanted_px)

        for done in calibrate_bank(source, views, bank, step=step, name=name):
            save_bank(done.bank, out)
            typer.echo(f"focus {done.focus:g} is in {out}; {done.left} to go")


def _guided_views(
    images: "Iterator[Image]", board: "Board", wanted_px: float
) -> "Sequence[BoardView]":
    """Return the views of a guided session, telling what to do next when it changes."""
    from tagmetry.pipeline.guided import guided

    session, text = None, ""
    for step in guided(images, board, wanted_px):
        session = step.session
        if session.next.text != text:
            text = session.next.text
            typer.echo(f"-> {text}")
    return session.taken if session is not None else ()

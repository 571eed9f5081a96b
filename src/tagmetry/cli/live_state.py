"""Says on standard error when a live source is lost, frozen or back again."""

from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from tagmetry.sources import LiveState


class StateTeller:
    """Tells the states of a source that has run; one that never did is reported as an error."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._has_run = False

    def __call__(self, state: "LiveState") -> None:
        """Tell one change of state on one line."""
        if self._has_run and state.kind != "closed":
            again = " again" if state.kind == "running" else ""
            reason = f": {state.reason}" if state.reason else ""
            typer.echo(f"tagmetry: {self._name}: {state.kind}{again}{reason}", err=True)
        self._has_run |= state.kind == "running"

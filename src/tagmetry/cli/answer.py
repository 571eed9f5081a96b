"""How a subcommand answers: lines for people, or JSON for programs."""

import json as json_text
from collections.abc import Callable, Iterable

import typer


def answer(*, json: bool, table: Callable[[], object], lines: Callable[[], Iterable[str]]) -> None:
    """Print the one that is asked for; the other is not made.

    Args:
        json: Print JSON.
        table: Makes what JSON holds.
        lines: Makes the lines.
    """
    typer.echo(json_text.dumps(table()) if json else "\n".join(lines()))

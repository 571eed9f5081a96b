"""Whoever takes the results of an arena: a link to robots, a recorder, a page, a file."""

from typing import Protocol

from tagmetry.pipeline.arena.measurement import ArenaResult


class Taker(Protocol):
    """Takes results one after another."""

    def take(self, result: ArenaResult) -> None:
        """Take the result of one image."""

    def close(self) -> None:
        """There will be no more; called once."""

"""The engines of a run, each in its own process, alive as far as possible."""

from collections.abc import Sequence

from tagmetry.closing import Closing
from tagmetry.lab.bench.case import Case
from tagmetry.lab.engines import Child, EngineKind, Patience


class Team(Closing):
    """Engines that may use so many threads; those that died come back for the next case.

    Args:
        kinds: The engines.
        threads: For each of them.
        patience: How long each may be silent.
    """

    def __init__(self, kinds: Sequence[EngineKind], threads: int, patience: Patience) -> None:
        self.threads = threads
        self._kinds, self._patience = tuple(kinds), patience
        self._children: dict[tuple[str, str], Child] = {}

    def start(self, family: str) -> None:
        """Start all engines for a family, so that they are ready when the images are."""
        for kind in self._kinds:
            if kind.knows(family):
                self._alive(kind, family)

    def members(self, case: Case) -> list[Child]:
        """Return the engines that know the family; trackers only where something moves.

        Those of other families end: there are many families, and little memory.
        """
        for key in [key for key in self._children if key[1] != case.family]:
            self._children.pop(key).close()
        return [
            self._alive(kind, case.family)
            for kind in self._kinds
            if kind.knows(case.family) and (case.moves or not kind.tracks)
        ]

    def close(self) -> None:
        """End all processes."""
        while self._children:
            self._children.popitem()[1].close()

    def _alive(self, kind: EngineKind, family: str) -> Child:
        key = (kind.name, family)
        if key in self._children and self._children[key].is_dead:
            self._children.pop(key).close()
        if key not in self._children:
            self._children[key] = Child(kind, family, self.threads, self._patience)
        return self._children[key]

"""Two runs of the bench beside each other."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.lab.bench.results import Results
from tagmetry.lab.bench.row import Row
from tagmetry.lab.engines import OURS, TRACKER


@dataclass(frozen=True)
class Change:
    """One engine on one case, before and now.

    Attributes:
        before: Its row in the former run.
        now: In this one.
    """

    before: Row
    now: Row

    @property
    def time(self) -> float | None:
        """The time now by that before."""
        return _quotient(self.now.p50_ms, self.before.p50_ms)

    @property
    def corner_rms(self) -> float | None:
        """The corners' error now by that before."""
        return _quotient(self.now.corner_rms_px, self.before.corner_rms_px)


@dataclass(frozen=True)
class Comparison:
    """What changed from a former run to this one.

    Attributes:
        changes: Of what is in both.
        notes: What a reader must know of the two, in words.
    """

    changes: tuple[Change, ...]
    notes: tuple[str, ...]


def compared(now: Results, before: Results) -> Comparison:
    """Return what changed.

    Raises:
        InputError: The runs have nothing in common.
    """
    changes = tuple(
        Change(old, row)
        for row in now.rows
        if (old := before.of(row.case, row.engine, row.threads)) is not None
    )
    if not changes:
        raise InputError(
            "the former run has none of these cases and engines with as many threads; "
            "run the same ones"
        )
    return Comparison(changes, tuple(_notes(now, before, changes)))


def _notes(now: Results, before: Results, changes: Sequence[Change]) -> list[str]:
    notes = []
    if now.machine.hardware != before.machine.hardware:
        notes.append(
            f"other machine: {before.machine.hardware} before, {now.machine.hardware} now; "
            "compare the times with those of the peers, not with each other"
        )
    for name, found in sorted(now.machine.packages.items()):
        former = before.machine.packages.get(name, "none")
        if former != found:
            notes.append(f"{name} {former} before, {found} now")
    peers = [c.time for c in changes if c.time and c.now.engine not in (OURS, TRACKER)]
    if peers:
        notes.append(
            f"the peers took {np.median(peers):.2f} of their former time (median): "
            "so much is the machine, not the program"
        )
    return notes


def _quotient(now: float | None, before: float | None) -> float | None:
    return now / before if now is not None and before else None

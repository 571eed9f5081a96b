"""Nothing found, and no cause seen: say what was looked for and what is there instead."""

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.unread import NEEDED_PX_PER_CELL

_MOST_NAMED = 3


def nothing_there(evidence: Evidence) -> Advice:
    """Say that no marker is there, and how large one would have to be."""
    least_px = NEEDED_PX_PER_CELL * min(one.layout.side_cells for one in evidence.families)
    return Advice(
        "problem",
        "no marker-like squares",
        f"{_squares(evidence)} (looked for: {_looked_for(evidence)})",
        f"if there is a marker: its sides must be {least_px:.0f} px or longer, flat, "
        "unobstructed, and with white all around; a family of your own must be named",
    )


def _squares(evidence: Evidence) -> str:
    count = len(evidence.squares)
    if count == 0:
        return "no square with a dark border is in the picture"
    squares = "1 square" if count == 1 else f"{count} squares"
    sides_px = sorted(one.side_px for one in evidence.squares)
    return (
        f"{squares} with a dark border, sides of {sides_px[0]:.0f} to {sides_px[-1]:.0f} px, "
        "but no better match to any code than texture gives"
    )


def _looked_for(evidence: Evidence) -> str:
    if not evidence.wanted or len(evidence.wanted) > _MOST_NAMED:
        return f"{len(evidence.wanted) or 'all'} families"
    return ", ".join(one.name for one in evidence.wanted)

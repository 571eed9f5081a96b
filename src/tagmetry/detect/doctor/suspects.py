"""Squares that are almost a marker: their bits come nearer to a code than accident does."""

from collections.abc import Sequence

from tagmetry.detect.detection import Detection
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.markers import MarkerFamily

_LEAST_SURPRISE = 0.02  # expected number of accidents among all squares of the image


def suspects(evidence: Evidence) -> tuple[Detection, ...]:
    """Return the squares that were probably printed as a marker of the families looked for."""
    families = {one.name: one for one in evidence.families}
    tries = len(evidence.squares) * len(families)
    return tuple(
        one for one in evidence.squares if _chance(one, families) * tries <= _LEAST_SURPRISE
    )


def _chance(square: Detection, families: dict[str, MarkerFamily]) -> float:
    return families[square.family].chance_of_random_match(square.hamming)


def px_per_cell(squares: Sequence[Detection], families: Sequence[MarkerFamily]) -> list[float]:
    """Return the width of a cell of each square, px."""
    cells = {one.name: one.layout.side_cells for one in families}
    return [square.side_px / cells[square.family] for square in squares]

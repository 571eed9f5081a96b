"""A single clear, large marker of a small family may be one, or may be texture."""

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group

_CLEAR = 0.8
_LARGE_PX = 40.0


def check_perhaps(evidence: Evidence) -> tuple[Advice, ...]:
    """Name markers of any family that are clear, but too few to be sure of."""
    if evidence.found:
        return ()
    return tuple(_advice(group) for group in evidence.present if _is_clear(group))


def _is_clear(group: Group) -> bool:
    return any(d.confidence > _CLEAR and d.side_px > _LARGE_PX for d in group.detections)


def _advice(group: Group) -> Advice:
    look = " printed white on black" if group.is_inverted else ""
    return Advice(
        "hint",
        "perhaps a marker",
        f"{group}{look} may be there; texture passes for so small a code now and then",
        f"if it is one: --family {group.family.name}",
    )

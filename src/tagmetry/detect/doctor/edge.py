"""Does a marker that is found touch the image's edge?"""

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group


def check_edge(evidence: Evidence) -> tuple[Advice, ...]:
    """Name the markers whose corners the image's edge may cut off."""
    return tuple(advice for group in evidence.found for advice in _of_group(group))


def _of_group(group: Group) -> tuple[Advice, ...]:
    cut = tuple(one for one in group.detections if one.touches_border)
    if not cut:
        return ()
    return (
        Advice(
            "hint",
            "at the image's edge",
            f"{Group(group.family, cut)} reaches the edge of the picture: corners there may be "
            "cut off, and are then wrong",
            "keep the whole marker and its white surround in the picture",
        ),
    )

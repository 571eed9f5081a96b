"""Is the print, or the picture of it, a mirror image?"""

from tagmetry.detect.detector import Detector
from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group, grouped


def check_mirrored(evidence: Evidence) -> tuple[Advice, ...]:
    """Look for the wanted markers in the flipped image, where none is found as it is."""
    if evidence.found or evidence.others:
        return ()
    flipped = Detector(evidence.families, inverted=True).detect(evidence.grey[:, ::-1])
    groups = grouped(flipped, evidence.families)
    return tuple(_advice(group) for group in groups if group.is_sure(tries=2))


def _advice(group: Group) -> Advice:
    look = ", and printed white on black" if group.is_inverted else ""
    return Advice(
        "problem",
        "mirror image",
        f"{group} found only after the picture was flipped left to right{look}",
        "switch off the camera's mirror (selfie) mode; if the picture was not taken through a "
        "mirror or glass, the print itself is mirrored: print it again",
    )

"""Does one id stand in the image twice?"""

from tagmetry.detect.doctor.advice import Advice
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group


def check_duplicates(evidence: Evidence) -> tuple[Advice, ...]:
    """Name ids that are seen in more than one place."""
    return tuple(advice for group in evidence.found for advice in _of_group(group))


def _of_group(group: Group) -> tuple[Advice, ...]:
    counts = {one: sum(d.id == one for d in group.detections) for one in group.ids}
    repeated = [f"id {one} ({count} times)" for one, count in counts.items() if count > 1]
    if not repeated:
        return ()
    return (
        Advice(
            "hint",
            "an id more than once",
            f"{group.family.name}: {', '.join(repeated)}; two prints, or a reflection",
            "where positions count, let every id exist once; cover shiny surfaces",
        ),
    )

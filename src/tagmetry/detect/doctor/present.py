"""Are markers there that were not asked for: another family, another border, inverted print?"""

from tagmetry.detect.doctor.advice import Advice, Severity
from tagmetry.detect.doctor.evidence import Evidence
from tagmetry.detect.doctor.groups import Group


def check_present(evidence: Evidence) -> tuple[Advice, ...]:
    """Name the markers in the image that the detector was not asked for."""
    severity: Severity = "hint" if evidence.found else "problem"
    return tuple(_advice(group, evidence, severity) for group in evidence.others)


def _advice(group: Group, evidence: Evidence, severity: Severity) -> Advice:
    if group.is_inverted:
        return _inverted(group, severity)
    asked = ", ".join(one.name for one in evidence.wanted)
    other_border = [
        one for one in evidence.wanted if _differ_in_border(one.name, group.family.name)
    ]
    if other_border:
        return _border(group, other_border[0].layout.border_cells, severity)
    return Advice(
        severity,
        "another family",
        f"{group} in the picture; asked for was {asked}",
        f"--family {group.family.name}",
    )


def _inverted(group: Group, severity: Severity) -> Advice:
    return Advice(
        severity,
        "inverted print",
        f"{group} printed white on black",
        "print it black on white, or look for inverted markers too: Detector(..., inverted=True)",
    )


def _border(group: Group, asked_cells: int, severity: Severity) -> Advice:
    cells = group.family.layout.border_cells
    return Advice(
        severity,
        "another width of border",
        f"{group}: the black border is {_cells(cells)} wide; asked for was {_cells(asked_cells)} "
        "(Kalibr prints two, most others one); read as asked, corners may lie inside the border",
        f"--family {group.family.name}; the size is then the side of the whole black square",
    )


def _cells(count: int) -> str:
    return f"{count} cell{'s' if count > 1 else ''}"


def _differ_in_border(one: str, other: str) -> bool:
    plain, _, border = one.partition("_border")
    other_plain, _, other_border = other.partition("_border")
    return _kind(plain) == _kind(other_plain) and border != other_border


def _kind(name: str) -> str:
    """Return what subsets of one dictionary have in common: `4x4` of `4x4_50`."""
    return name.partition("_")[0] if name[:1].isdigit() else name

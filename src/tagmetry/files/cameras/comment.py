"""Our section as a comment, for text formats that have no place for other keys."""

import json

from tagmetry.camera import Camera
from tagmetry.files.cameras.section import Section, section_of
from tagmetry.files.checked import checked
from tagmetry.files.json_text import parse_json
from tagmetry.files.text import named_errors

_MARK = "# tagmetry: "


def section_comment(camera: Camera, coefficient_count: int | None = None) -> str:
    """Return one line that readers of the format pass over.

    Args:
        camera: What it says more about.
        coefficient_count: How many coefficients are meant, where the format pads them.
    """
    table = {"name": camera.name} | section_of(camera)
    if coefficient_count is not None:
        table["coefficient_count"] = coefficient_count
    return _MARK + json.dumps(table) + "\n"


def commented_section(text: str) -> Section:
    """Return what the first such line of a text says, an empty section where there is none."""
    for line in text.splitlines():
        if line.startswith(_MARK):
            with named_errors("tagmetry"):
                return checked(Section, parse_json(line.removeprefix(_MARK)))
    return Section()

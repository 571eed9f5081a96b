"""The pictures of all stages in a folder, and the page that shows them in order."""

from collections.abc import Sequence
from pathlib import Path

from tagmetry.detect.stages import Stages
from tagmetry.errors import InputError
from tagmetry.files import write_atomically
from tagmetry.record.stages.page import page
from tagmetry.record.stages.panel import Panel, captioned, png
from tagmetry.record.stages.published import seed_001_panels, seed_003_panels
from tagmetry.record.stages.reading import reading_panels
from tagmetry.record.stages.refinement import refinement_panels
from tagmetry.record.stages.segmentation import segmentation_panels


def write_stages(stages: Stages, folder: str | Path) -> tuple[Path, ...]:
    """Write numbered PNG pictures and `index.html` into a folder, which is made if need be.

    Returns:
        The files.

    Raises:
        InputError: They cannot be written there.
    """
    home = Path(folder)
    try:
        home.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot make the folder {home}: {error.strerror}") from error
    groups = grouped_panels(stages)
    panels = [panel for _, several in groups for panel in several]
    contents: dict[str, bytes | str] = {
        f"{number:02d}-{panel.name}.png": png(captioned(panel, number))
        for number, panel in enumerate(panels, start=1)
    }
    contents["index.html"] = page(groups)
    for name, content in contents.items():
        write_atomically(home / name, content)
    return tuple(home / name for name in contents)


def grouped_panels(stages: Stages) -> list[tuple[str, Sequence[Panel]]]:
    """Return the panels of all stages under their titles."""
    ours = [
        *segmentation_panels(stages),
        *reading_panels(stages),
        *refinement_panels(stages),
    ]
    return [
        ("The detector", ours),
        ("The same image as in seed 003, table 2", list(seed_003_panels(stages))),
        ("The same image as in seed 001, figure 8", list(seed_001_panels(stages))),
    ]

"""Draw the laboratory's figures for the docs from its results: make_lab_pictures.py lab-results."""

import sys
from pathlib import Path

from tagmetry.lab.report.chapter import chapters

IMAGES = Path(__file__).parent / "images" / "lab"
DRAWN = (
    "detector_light", "detector_motion", "detector_side", "lens_limits", "seed000_figure10",
    "seed000_figure11", "seed000_figure12", "seed000_figure13", "seed000_figure14",
    "seed000_figure15", "seed000_figure9", "seed001_figure10",
    "seed001_figure12", "seed001_figure13a", "seed001_figure13b", "seed001_figure14",
    "seed001_figure9_paper", "seed001_figure9_tagmetry", "seed002_figure17", "seed002_sights",
    "seed003_figure12", "seed004_figure12", "seed004_figure7", "seed004_figure8",
    "swarm_curves", "swarm_aggregate_100", "swarm_disperse_100", "swarm_formation_24",
)  # fmt: skip
DPI = 80


def main(results: Path) -> None:
    IMAGES.mkdir(parents=True, exist_ok=True)
    for chapter in chapters(results):
        for figure in chapter.conclusions.figures:
            if figure.name in DRAWN:
                target = IMAGES / f"{figure.name}.png"
                figure.draw().savefig(target, dpi=DPI, metadata={"Software": None})


if __name__ == "__main__":
    main(Path(sys.argv[1]))

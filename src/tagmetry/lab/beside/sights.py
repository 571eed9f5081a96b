"""What the camera of seed 002 sees: its figures 3, 7, 10, 13, 15, 19, 21 and 26 at a glance."""

from typing import TYPE_CHECKING

import numpy as np

from tagmetry.lab.rigs.marker_floor import LayoutName, Stand, camera_place, picture
from tagmetry.record.report import ReportFigure
from tagmetry.record.report.plot import blank

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_GROUPS: tuple[tuple[int, LayoutName], ...] = (
    (13, "two"),
    (15, "four"),
    (19, "four inclined"),
    (21, "four and one perpendicular"),
)
_SIGHTS = (
    ("3: one", Stand("one", 1.2, 20.0)),
    ("7: pitch", Stand("one", 1.2, 0.0, 40.0)),
    ("10: roll", Stand("one", 1.2, 0.0, 0.0, 40.0)),
    *((f"{number}: {layout}", Stand(layout, 1.0)) for number, layout in _GROUPS),
    *((f"{number}: {layout}", Stand(layout, 2.0, 50.0)) for number, layout in _GROUPS),
)


def sights_figure() -> ReportFigure:
    """Return pictures of the set-ups, as the twin renders them."""

    def draw() -> "Figure":
        figure, _ = blank(8.8, 5.6)
        figure.clear()
        grid = figure.subplots(3, 4)
        for axes in grid.flat:
            axes.axis("off")
        for axes, (name, stand) in zip(grid.flat, _SIGHTS, strict=False):
            rng = np.random.default_rng(0)
            pixels = picture(stand, camera_place(stand, rng), rng)
            axes.imshow(pixels[::2, ::2], cmap="gray", vmin=0, vmax=255)
            axes.set_title(f"{name}, {stand.distance_m:g} m", fontsize=8)
        return figure

    return ReportFigure(
        "seed002_sights",
        "Figures 3, 7, 10, 13, 15, 19 and 21: what the camera sees",
        "Markers of 200 mm at 640x480 pixels, rendered.",
        draw,
    )

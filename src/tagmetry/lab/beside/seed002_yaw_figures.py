"""Figures 4 to 6 and 13 to 25 of seed 002, drawn again."""

from collections.abc import Iterator, Sequence

from tagmetry.lab.beside.curves import Curve, Plot, curve_figure, surface_figure
from tagmetry.lab.beside.sample import Sample
from tagmetry.lab.beside.sights import sights_figure
from tagmetry.lab.published.seed002 import seed002
from tagmetry.record.report import ReportFigure

SURFACES = {4: "one", 14: "two", 16: "four", 20: "four inclined", 22: "four and one perpendicular"}
"""Layouts by the number of the figure that shows them as a surface."""


def every_figure(everything: Sample, exact: Sample) -> Iterator[ReportFigure]:
    """Give all figures, not drawn yet.

    Args:
        everything: All pictures.
        exact: Those of the simulator.
    """
    yield sights_figure()
    real = everything.where(look="webcam")
    yield surface_figure(4, "one marker", exact.where(layout="one"), "yaw_deg")
    yield _pair(5, "one marker, as a webcam sees it", _both(real), "distance_m")
    yield _pair(6, "one marker, as a webcam sees it", _both(real), "yaw_deg")
    for number, layout in list(SURFACES.items())[1:3]:
        yield surface_figure(number, f"{layout} markers", exact.where(layout=layout), "yaw_deg")
    counts = _layouts(exact, "one", "two", "four")
    yield _pair(17, "1, 2 and 4 markers", counts, "distance_m")
    yield _pair(18, "1, 2 and 4 markers", counts, "yaw_deg")
    for number, layout in list(SURFACES.items())[3:]:
        yield surface_figure(number, layout, exact.where(layout=layout), "yaw_deg")
    planes = _layouts(exact, "four inclined", "four and one perpendicular")
    yield _pair(23, "with and without a perpendicular marker", planes, "distance_m")
    yield _pair(24, "with and without a perpendicular marker", planes, "yaw_deg")
    plots = [Plot(e, x) for e in ("xy_m", "abs_z_m") for x in ("distance_m", "yaw_deg")]
    yield curve_figure(25, "XY and Z apart", planes, plots)


def _pair(number: int, title: str, curves: Sequence[Curve], against: str) -> ReportFigure:
    return curve_figure(
        number, title, curves, [Plot("radial_m", against), Plot("angle_deg", against)]
    )


def _both(rows: Sample) -> tuple[Curve, ...]:
    return Curve("ours", rows.ours), Curve("the paper's steps", rows.paper, 1, dashed=True)


def _layouts(exact: Sample, *names: str) -> tuple[Curve, ...]:
    """Return ours and the paper's steps for layouts, with what the paper says of them."""
    stated = seed002().statements
    ours = [
        Curve(
            f"{name}, ours",
            exact.ours.where(layout=name),
            color,
            stated=tuple(one for one in stated if one.layout == name),
        )
        for color, name in enumerate(names)
    ]
    theirs = [
        Curve(f"{name}, its steps", exact.paper.where(layout=name), color, dashed=True)
        for color, name in enumerate(names)
    ]
    return (*ours, *theirs)

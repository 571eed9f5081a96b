"""The report as one page: no script, nothing from elsewhere, readable in light and dark."""

from collections.abc import Iterator, Sequence
from html import escape

from tagmetry.record.calibration_report.facts import CalibrationFacts
from tagmetry.record.calibration_report.figures import every_figure
from tagmetry.record.calibration_report.tables import (
    choice_table,
    distortion_table,
    error_table,
    matrix_table,
    parameter_table,
    pose_error_table,
    pose_table,
    short_name,
    view_names,
)
from tagmetry.record.calibration_report.thumbnails import jpeg, outlined
from tagmetry.record.report import ReportFigure, ReportTable
from tagmetry.record.report.html import (
    document,
    figure_html,
    image_html,
    list_html,
    table_html,
    titled_table_html,
)

_MOST_THUMBNAILS = 40
_GRADES = {"good": "Good", "usable": "Usable", "poor": "Poor"}


def page(facts: CalibrationFacts) -> str:
    """Return the report as HTML.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    figures = {figure.name: figure for figure in every_figure(facts)}
    return document("Camera calibration", "\n".join(_sections(facts, figures)))


def _sections(facts: CalibrationFacts, figures: dict[str, ReportFigure]) -> Iterator[str]:
    calibration = facts.calibration
    yield _header(facts)
    yield _section("Verdict", _verdict(facts))
    yield _section("Camera", table_html(parameter_table(calibration)), _TWO_DEVIATIONS)
    yield _section("Uncertainty over the image", figure_html(figures["uncertainty"]))
    yield _section("Residual field", figure_html(figures["residuals"]))
    yield _section("Coverage", figure_html(figures["coverage"]), figure_html(figures["tilts"]))
    yield _section("Views", figure_html(figures["errors"]), _thumbnails(facts), _rejected(facts))
    yield _section("Choice of the lens", *_choice(facts))
    if facts.pose_errors:
        shown = (figure_html(figures["pose_errors"]), table_html(pose_error_table(facts)))
        yield _section("Error of a marker's pose", *shown)
    tables = (
        matrix_table(calibration),
        distortion_table(calibration),
        pose_table(calibration),
        error_table(facts),
    )
    yield _section("Tables", _FRAMES, *(titled_table_html(table) for table in tables))


_TWO_DEVIATIONS = (
    "<p class='note'>The standard deviation allows for errors that depend on each other within a "
    "view; the usual formula, which most programs print, does not.</p>"
)
_FRAMES = (
    "<p class='note'>Rotation vectors and translations take the board's coordinates (x right, y "
    "up, z out of its face, from its centre) to the camera's (x right, y down, z forward). The "
    "error “as seed 003 counts” is the mean over the views of the norm of all errors divided by "
    "the number of corners, as OpenCV's tutorial has it.</p>"
)


def _header(facts: CalibrationFacts) -> str:
    camera, views = facts.calibration.camera, len(facts.calibration.views)
    grade = facts.verdict.grade
    return (
        f"<header><h1>Camera calibration</h1><p>{camera.width_px} by {camera.height_px} px, "
        f"{views} views of <code>{escape(facts.board)}</code></p>"
        f"<p class='badge {grade}'>{_GRADES[grade]}</p>"
        f"<p class='note'>{escape(camera.provenance)}</p></header>"
    )


def _verdict(facts: CalibrationFacts) -> str:
    told = facts.verdict
    parts = [f"<p>{escape(told.words)}</p>"]
    parts += _list("Fit for", told.fit_for)
    parts += _list("Weak", told.warnings)
    parts += _list("The board", facts.remarks)
    return "".join(parts)


def _list(title: str, entries: Sequence[str]) -> list[str]:
    if not entries:
        return []
    return [f"<h3>{escape(title)}</h3>{list_html(entries)}"]


def _choice(facts: CalibrationFacts) -> Iterator[str]:
    table = choice_table(facts.calibration)
    if table is None or facts.calibration.choice is None:
        yield "<p>The lens was asked for by name; none were compared.</p>"
        return
    yield f"<p>{escape(facts.calibration.choice.reason)}.</p>"
    yield table_html(table)


def _section(title: str, *parts: str) -> str:
    return f"<section><h2>{escape(title)}</h2>{''.join(parts)}</section>"


def _thumbnails(facts: CalibrationFacts) -> str:
    calibration = facts.calibration
    each = zip(
        facts.thumbnails,
        calibration.views,
        calibration.kept,
        view_names(calibration),
        calibration.view_rms_px,
        strict=True,
    )
    shown = [
        f"<figure>{_thumbnail(jpeg(outlined(small, view, kept)), name)}"
        f"<figcaption>{escape(name)}<br>{rms_px:.3f} px</figcaption></figure>"
        for small, view, kept, name, rms_px in each
        if small.size
    ]
    more = len(shown) - _MOST_THUMBNAILS
    rest = f"<p class='note'>and {more} more</p>" if more > 0 else ""
    return f"<div class='thumbs'>{''.join(shown[:_MOST_THUMBNAILS])}</div>{rest}"


def _thumbnail(content: bytes, name: str) -> str:
    return image_html(content, "jpeg", f"{name} with its corners")


def _rejected(facts: CalibrationFacts) -> str:
    if not facts.rejected:
        return "<p>Every picture was used.</p>"
    rows = tuple((short_name(one.source), one.reason) for one in facts.rejected)
    table = ReportTable("rejected", "Pictures that were not used", ("picture", "why"), rows)
    summary = f"<summary>{len(rows)} pictures were not used</summary>"
    return f"<details>{summary}{table_html(table)}</details>"

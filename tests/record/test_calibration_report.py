"""The report's page, figures and tables, of a calibration whose truth is known."""

import base64
import csv
import re
import sys
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.calibrate.guidance import measure, verdict
from tagmetry.calibrate.quality import Place, pose_error
from tagmetry.calibrate.view import BoardView, RejectedView, round_covariances
from tagmetry.calibrate.views_to_camera import calibrate
from tagmetry.camera import Camera
from tagmetry.errors import InputError, MissingExtraError
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard
from tagmetry.record.calibration_report import (
    CalibrationFacts,
    NamedPoseError,
    write_figures,
    write_report,
    write_tables,
)
from tagmetry.record.calibration_report.thumbnails import outlined

BOARD = Chessboard(9, 6, 0.025)
TRUTH = Camera(640, 480, (600.0, 602.0), (321.0, 236.0))
HOSTILE = "<script>alert('1')</script>.png"


@cache
def facts() -> CalibrationFacts:
    rng, views = np.random.default_rng(5), []
    while len(views) < 8:
        turn = Rotation.from_rotvec([*np.radians(rng.uniform(-40, 40, 2)), rng.uniform(-1, 1)])
        turn = turn * Rotation.from_euler("x", 180, degrees=True)
        place = np.array([*rng.uniform(-0.1, 0.1, 2), rng.uniform(0.35, 0.55)])
        pixels = TRUTH.project(turn.apply(BOARD.corners_m) + place)
        if TRUTH.contains(pixels).all():
            pixels = pixels + rng.normal(0, 0.1, pixels.shape)
            name = HOSTILE if not views else f"folder/{len(views)}.png"
            points, spread = np.arange(54), round_covariances(np.full(54, 0.1))
            views.append(BoardView(640, 480, points, BOARD.corners_m, pixels, spread, name))
    solved = calibrate(views)
    evidence = measure(solved, 0.1)
    error = pose_error(solved, 0.1, [Place((320.0, 240.0), 1.0)])[0]
    return CalibrationFacts(
        "chessboard:9x6:25mm",
        solved,
        verdict(solved, BOARD, evidence=evidence),
        (NamedPoseError("middle", 0.1, error),),
        (RejectedView("lost.png", "no chessboard & <nothing>"),),
        tuple(np.full((180, 240), 90, np.uint8) for _ in solved.views),
        ("printed at another scale",),
    )


class Page(HTMLParser):
    """Collects what a page is made of."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.words: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in ("meta", "img", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append(data)

    def named(self, tag: str) -> list[dict[str, str | None]]:
        return [attrs for name, attrs in self.tags if name == tag]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Page:
    path = tmp_path_factory.mktemp("report") / "report.html"
    write_report(facts(), path)
    parsed = Page(path.read_text("utf-8"))
    assert parsed.open == []
    return parsed


def test_the_page_has_a_section_for_everything(page: Page) -> None:
    text = " ".join(page.words)
    for title in (
        "Verdict", "Camera", "Uncertainty over the image", "Residual field", "Coverage", "Views",
        "Choice of the lens", "Error of a marker's pose", "Camera matrix", "Distortion",
        "Rotation and translation of every view", "Errors",
    ):  # fmt: skip
        assert title in text
    assert facts().verdict.words in text
    assert "printed at another scale" in text
    assert "no chessboard & <nothing>" in text


def test_the_page_needs_nothing_from_elsewhere_and_runs_nothing(page: Page) -> None:
    assert {tag for tag, _ in page.tags}.isdisjoint({"script", "link", "iframe", "object"})
    for _, attrs in page.tags:
        assert not any(name.startswith("on") for name in attrs)
        assert all(str(attrs[key]).startswith("data:") for key in ("src", "href") if key in attrs)


def test_every_picture_says_what_it_shows_and_can_be_decoded(page: Page) -> None:
    images = page.named("img")
    assert len(images) == 6 + len(facts().calibration.views)
    for image in images:
        assert len(image["alt"]) > 10
        kind, _, content = image["src"].partition(";base64,")
        decoded = base64.b64decode(content, validate=True)
        if kind == "data:image/jpeg":
            assert cv2.imdecode(np.frombuffer(decoded, np.uint8), 1).shape == (180, 240, 3)
        else:
            assert decoded.lstrip().startswith(b"<?xml")
            assert b"<script" not in decoded


def test_tables_have_as_many_cells_as_headings(page: Page, tmp_path: Path) -> None:
    path = tmp_path / "r.html"
    write_report(facts(), path)
    for table in re.findall(r"<table>.*?</table>", path.read_text("utf-8"), re.DOTALL):
        columns = table.count("<th ")
        rows = table.partition("<tbody>")[2].split("</tr>")[:-1]
        assert rows
        assert {row.count("<td") for row in rows} == {columns}


def test_the_same_calibration_gives_the_same_page(tmp_path: Path) -> None:
    first, second = tmp_path / "1.html", tmp_path / "2.html"
    write_report(facts(), first)
    write_report(facts(), second)
    assert first.read_bytes() == second.read_bytes()


def rows_of(path: Path) -> list[list[str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def test_the_seeds_tables_say_what_was_solved_to_the_last_digit(tmp_path: Path) -> None:
    write_tables(facts(), tmp_path)
    solved = facts().calibration
    matrix = np.array(rows_of(tmp_path / "table3_camera_matrix.csv")[1:], dtype=float)
    np.testing.assert_array_equal(matrix, solved.camera.matrix)
    lens = rows_of(tmp_path / "table4_distortion.csv")[1:]
    assert tuple(float(row[1]) for row in lens) == solved.camera.lens.coefficients
    poses = rows_of(tmp_path / "table5_views.csv")[1:]
    assert [row[0] for row in poses[1:]] == [f"{i}.png" for i in range(1, 8)]
    numbers = np.array([row[1:] for row in poses], dtype=float)
    turns = Rotation.from_rotvec(np.radians(numbers[:, :3]))
    p_camera = turns.apply(np.tile([0.1, 0.05, 0.0], (8, 1))) + numbers[:, 3:] / 1e3
    expected = np.array([T.apply([0.1, 0.05, 0.0]) for T in solved.Ts_camera_board])
    np.testing.assert_allclose(p_camera, expected, atol=1e-12)


def test_the_errors_of_all_views_follow_from_the_errors_of_each(tmp_path: Path) -> None:
    write_tables(facts(), tmp_path)
    *views, every, seed = rows_of(tmp_path / "table6_errors.csv")[1:]
    corners, errors = np.array([[row[1], row[3]] for row in views], dtype=float).T
    assert float(every[3]) == pytest.approx(np.sqrt((corners * errors**2).sum() / corners.sum()))
    assert float(seed[3]) == pytest.approx(np.mean(errors / np.sqrt(corners)))
    assert float(every[3]) == pytest.approx(0.1 * np.sqrt(2), rel=0.15)


def test_figures_are_pictures_of_some_size(tmp_path: Path) -> None:
    files = write_figures(facts(), tmp_path / "new" / "folder")
    assert [file.stem for file in files] == [
        "uncertainty", "residuals", "coverage", "tilts", "errors", "pose_errors",
    ]  # fmt: skip
    for file in files:
        pixels = cv2.imread(str(file))
        assert min(pixels.shape[:2]) > 400
        assert pixels.std() > 10


def test_a_calibration_of_few_views_and_no_choice_has_a_page_too(tmp_path: Path) -> None:
    solved = calibrate(facts().calibration.views[:3], "none")
    few = replace(
        facts(),
        calibration=solved,
        verdict=verdict(solved, BOARD),
        pose_errors=(),
        rejected=(),
        thumbnails=tuple(np.zeros((0, 0), np.uint8) for _ in solved.views),
    )
    write_report(few, tmp_path / "few.html")
    text = (tmp_path / "few.html").read_text("utf-8")
    assert "none were compared" in text
    assert "Every picture was used." in text
    assert not re.search(r"<td[^>]*>(nan|inf)</td>", text)


def test_outlines_mark_corners_that_were_left_out() -> None:
    view, small = facts().calibration.views[1], np.full((180, 240), 90, np.uint8)
    kept = np.ones(54, dtype=bool)
    whole = outlined(small, view, kept)
    kept[20] = False
    changed = (outlined(small, view, kept) != whole).any(axis=2)
    v, u = (int(c) for c in np.argwhere(changed).mean(axis=0).round())
    expected = (view.corners_px[20] + 0.5) * 240 / 640 - 0.5
    np.testing.assert_allclose([u, v], expected, atol=1.5)


def test_without_matplotlib_the_part_that_is_missing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(MissingExtraError, match=r"tagmetry\[report\]"):
        write_report(facts(), tmp_path / "r.html")
    assert list(tmp_path.iterdir()) == []
    assert len(write_tables(facts(), tmp_path)) == 7


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot make the folder"):
        write_tables(facts(), tmp_path / "file" / "below")

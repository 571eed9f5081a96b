"""AprilTag 3's newer families: we find what the library draws, the library finds what we print."""

import cv2
import numpy as np
import pytest
from printed_markers import printed

from tagmetry.detect import Detection, Detector
from tagmetry.detect.doctor import diagnose
from tagmetry.detect.expected import expected_picture
from tagmetry.markers import family

pyapriltags = pytest.importorskip("pyapriltags")
from apriltag_library import library_family  # noqa: E402 (it needs the library)

NAMES = (
    "tagStandard41h12",
    "tagStandard52h13",
    "tagCircle21h7",
    "tagCircle49h12",
    "tagCustom48h12",
)
CELL_PX, GROUND_PX = 12, 30
every_family = pytest.mark.parametrize("name", NAMES)


def pixels_of(
    cells: np.ndarray, *, white: int = 200, black: int = 40, ground: int = 255
) -> np.ndarray:
    """Return cells as a slightly blurred and noisy picture on some ground."""
    flat = np.kron(np.where(cells, white, black).astype(np.uint8), np.ones((CELL_PX, CELL_PX)))
    flat = np.pad(flat, GROUND_PX, constant_values=ground)
    noise = np.random.default_rng(0).normal(0, 2, flat.shape)
    return np.clip(cv2.GaussianBlur(flat, (0, 0), 0.8) + noise, 0, 255).astype(np.uint8)


def square_px(name: str) -> np.ndarray:
    """Return where the square's corners are in `pixels_of`."""
    layout = family(name).layout
    low = GROUND_PX + CELL_PX * layout.margin_cells - 0.5
    return low + CELL_PX * layout.side_cells * np.array([[0, 0], [1, 0], [1, 1], [0, 1]])


def the_one(found: tuple[Detection, ...]) -> Detection:
    (one,) = found
    return one


@every_family
@pytest.mark.parametrize("ground", [255, 200, 90, 0])
def test_the_library_s_drawing_is_found_on_any_ground(name: str, ground: int) -> None:
    """Its free cells are black, ours white: neither they nor the ground move a corner."""
    pixels = pixels_of(library_family(name).drawn(7), ground=ground)
    found = the_one(Detector([name]).detect(pixels))
    assert (found.family, found.id, found.hamming) == (name, 7, 0)
    np.testing.assert_allclose(found.corners_px, square_px(name), atol=0.03)
    error = (found.corners_px - square_px(name)).ravel()
    assert error @ np.linalg.solve(found.corners_cov_px2, error) < 22  # of 8: one in 200


def test_the_doctor_names_the_family_that_was_not_asked_for() -> None:
    pixels = pixels_of(family("tagStandard52h13").picture(30))
    (advice,) = diagnose(pixels, [family("tag36h11")])
    assert advice.title == "another family"
    assert "tagStandard52h13 id 30" in advice.explanation


@every_family
@pytest.mark.parametrize("quarters", range(4))
def test_turned_drawings_tell_their_own_top_left(name: str, quarters: int) -> None:
    pixels = np.rot90(pixels_of(library_family(name).drawn(3)), -quarters)
    found = the_one(Detector([name]).detect(np.ascontiguousarray(pixels)))
    assert found.id == 3
    expected = np.roll(square_px(name), -quarters, axis=0)
    np.testing.assert_allclose(found.corners_px, expected, atol=0.03)


@every_family
def test_inverted_prints_are_found_when_asked_for(name: str) -> None:
    pixels = 255 - pixels_of(family(name).picture(5))
    assert Detector([name]).detect(pixels) == ()
    found = the_one(Detector([name], inverted=True).detect(pixels))
    assert found.id == 5
    assert found.is_inverted
    np.testing.assert_allclose(found.corners_px, square_px(name), atol=0.03)


@pytest.mark.parametrize(
    "name",
    [  # the library takes half a minute to prepare a large family
        pytest.param(name, marks=pytest.mark.slow if len(family(name)) > 5000 else ())
        for name in NAMES
    ],
)
def test_the_library_finds_what_our_sheets_print(name: str) -> None:
    ids = [0, 5, len(family(name)) - 1]
    detector = pyapriltags.Detector(families=name, quad_decimate=1.0)
    ((sheet, corners_px),) = printed(family(name), ids)
    found = {tag.tag_id: tag for tag in detector.detect(sheet)}
    assert set(ids) <= set(found)
    for marker_id in ids:
        theirs = found[marker_id].corners[::-1] - 0.5
        np.testing.assert_allclose(theirs, corners_px[marker_id], atol=0.3)


def test_families_of_both_kinds_are_found_in_one_pass() -> None:
    new = pixels_of(family("tagStandard41h12").picture(11), ground=230)
    old = np.pad(pixels_of(family("tag36h11").picture(12), ground=230), [(0, 0), (10, 10)])
    size = max(len(new), len(old)) + 20, new.shape[1] + old.shape[1]
    both = np.full(size, 230, dtype=np.uint8)
    both[: len(new), : new.shape[1]] = new
    both[: len(old), new.shape[1] :] = old
    found = Detector(["tag36h11", "tagStandard41h12"]).detect(both)
    assert [(one.family, one.id) for one in found] == [("tag36h11", 12), ("tagStandard41h12", 11)]


def test_damaged_bits_are_forgiven_inside_and_outside_the_border() -> None:
    one = family("tagStandard41h12")
    cells = one.picture(20)
    cells[0, 4], cells[4, 4] = ~cells[0, 4], ~cells[4, 4]
    found = the_one(Detector([one]).detect(pixels_of(cells)))
    assert (found.id, found.hamming) == (20, 2)


def test_a_white_square_in_a_black_ring_is_no_marker_without_its_bits() -> None:
    cells = family("tagStandard41h12").picture(20)
    cells[:2], cells[-2:] = True, True
    assert Detector(["tagStandard41h12"]).detect(pixels_of(cells)) == ()


@pytest.mark.parametrize("white", [True, False])
def test_free_cells_are_expected_as_they_are_seen(white: bool) -> None:
    own = family("tagCustom48h12")
    cells = own.picture(9)
    cells[4:6, 4:6] = white
    picture = expected_picture(pixels_of(cells), square_px(own.name), own, 9)
    np.testing.assert_array_equal(picture.cells[1:-1, 1:-1], cells)
    assert picture.margin_cells == 3

"""What each stage says is so: held against the rendered truth, and the detector's own result."""

import cv2
import numpy as np
import pytest
from rendered_markers import Scene, scene

from tagmetry.detect import Detector
from tagmetry.detect.photometric import Picture
from tagmetry.detect.stages import Stages, look_through
from tagmetry.detect.stages.classic import classic, straightened
from tagmetry.detect.stages.parted import parted
from tagmetry.detect.stages.redrawn import Redrawn, redrawn
from tagmetry.detect.stages.sampled import sampled
from tagmetry.errors import InputError
from tagmetry.geometry import apply_homography, square_to_quad
from tagmetry.markers import family
from tagmetry.twin import Look

CLEAN = Look(black=40, white=200, noise=0.0, blur_px=0.6)
FAMILIES = ("tag36h11", "tagStandard41h12", "tagCircle21h7", "4x4_50")


def rendered(
    name: str = "tag36h11", look: Look = CLEAN, side_px: float = 80.0, **more: object
) -> Scene:
    return scene(np.random.default_rng(3), side_px, look=look, family=name, tilt_deg=20, **more)


def through(shown: Scene, name: str = "tag36h11") -> Stages:
    return look_through(shown.grey, Detector([name]), shown.camera)


def test_dark_is_what_lies_below_the_level() -> None:
    seen = parted(rendered().grey, 8.0)
    np.testing.assert_array_equal(seen.is_dark, seen.grey < seen.level)
    assert seen.scale == 0.5
    assert not seen.is_dark[seen.level == 0].any()


def test_outlines_lie_in_their_boxes_and_on_dark_pixels() -> None:
    seen = parted(rendered().grey, 8.0)
    assert len(seen.boxes) == len(seen.outlines) == len(seen.is_likely) > 0
    for (left, top, width, height), line in zip(seen.boxes.tolist(), seen.outlines, strict=True):
        np.testing.assert_array_equal(line.min(axis=0), [left, top])
        np.testing.assert_array_equal(line.max(axis=0), [left + width - 1, top + height - 1])
        x, y = line.astype(int).T
        assert seen.is_dark[y, x].all()


def test_noise_begins_few_outlines_and_a_marker_begins_one() -> None:
    rng = np.random.default_rng(1)
    texture = cv2.GaussianBlur(rng.normal(0, 60, (240, 320)), (0, 0), 2.0) + 150
    noise = np.clip(texture, 0, 255).astype(np.uint8)
    seen = parted(noise, 16.0)
    assert seen.begins.mean() < 0.8
    noise[80:160, 100:180] = 20
    again = parted(noise, 16.0)
    middles = again.boxes[:, :2] + again.boxes[:, 2:] / 2
    own = np.abs(middles - [70, 60]).max(axis=1).argmin()
    assert again.begins[own]
    assert again.is_likely[own]
    assert not (again.is_likely & ~again.begins).any()


def test_a_marker_s_border_is_a_likely_area() -> None:
    shown = rendered()
    seen = parted(shown.grey, 8.0)
    low, high = shown.corners_px.min(axis=0) / 2, shown.corners_px.max(axis=0) / 2
    expected = np.concatenate([low, high - low])
    apart = np.abs(seen.boxes[seen.is_likely] - expected).max(axis=1)
    assert apart.min() < 1.5


@pytest.mark.parametrize("name", FAMILIES)
def test_cells_read_as_they_were_printed(name: str) -> None:
    shown = rendered(name)
    read = sampled(shown.grey, shown.corners_px, family(name).layout)
    np.testing.assert_array_equal(read.is_white, family(name).codes[7])
    assert np.abs(read.margins).min() > 0.8
    np.testing.assert_allclose(read.levels, np.tile([40.0, 200.0], (len(read.levels), 1)), atol=6)


def test_black_and_white_follow_uneven_light() -> None:
    shown = rendered()
    slope = np.linspace(0.5, 1.0, shown.grey.shape[1])
    read = sampled(
        (shown.grey * slope).astype(np.uint8), shown.corners_px, family("tag36h11").layout
    )
    expected = np.interp(read.bits_px[:, 0], np.arange(len(slope)), slope)
    np.testing.assert_allclose(read.levels[:, 1], 200 * expected, atol=6)
    np.testing.assert_allclose(np.abs(read.margins), 1.0, atol=0.12)
    np.testing.assert_array_equal(read.is_white, family("tag36h11").codes[7])


def test_a_picture_drawn_at_the_truth_leaves_hardly_anything() -> None:
    shown = rendered()
    drawn = drawn_of(shown)
    assert np.nanstd(drawn.residual) < 1.0
    assert drawn.blur_px == pytest.approx(0.6, abs=0.03)
    assert drawn.exponent == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize("shift_px", [(0.1, 0.0), (0.0, 0.1), (-0.1, 0.0)])
def test_a_tenth_of_a_pixel_shows(shift_px: tuple[float, float]) -> None:
    shown = rendered()
    assert np.nanstd(drawn_of(shown, shift_px).residual) > 1.8


@pytest.mark.parametrize("exponent", [1.6, 2.2])
def test_the_exponent_of_a_gamma_curve_is_found(exponent: float) -> None:
    shown = rendered()
    encoded = np.rint(255 * (shown.grey / 255.0) ** (1 / exponent)).astype(np.uint8)
    drawn = redrawn(encoded, shown.corners_px, Picture(family("tag36h11").picture(7)))
    assert drawn.exponent == pytest.approx(exponent, rel=0.05)


def test_through_a_lens_edges_follow_the_camera() -> None:
    shown = rendered(coefficients=(-0.3, 0.1, 0.0, 0.0), aside_px=600.0)
    picture = Picture(family("tag36h11").picture(7))
    straight = redrawn(shown.grey, shown.corners_px, picture)
    followed = redrawn(shown.grey, shown.corners_px, picture, shown.camera)
    assert np.nanstd(followed.residual) < 1.2 < np.nanstd(straight.residual)


def drawn_of(shown: Scene, shift_px: tuple[float, float] = (0.0, 0.0)) -> Redrawn:
    picture = Picture(family("tag36h11").picture(7))
    return redrawn(shown.grey, shown.corners_px + np.array(shift_px), picture)


@pytest.mark.parametrize("name", FAMILIES)
def test_a_straightened_marker_is_its_printed_picture(name: str) -> None:
    shown = rendered(name)
    flat = straightened(shown.grey, shown.corners_px, family(name).layout)
    np.testing.assert_array_equal(flat.bits, family(name).picture(7))
    assert flat.grey.shape == flat.is_white.shape


def test_the_textbook_finds_edges_and_the_square() -> None:
    shown = rendered()
    steps = classic(shown.grey)
    quad = min(steps.quads, key=lambda one: np.abs(one.mean(0) - shown.corners_px.mean(0)).max())
    turned = [np.roll(step, -k, axis=0) for k in range(4) for step in (quad, quad[::-1])]
    assert min(np.abs(one - shown.corners_px).max() for one in turned) < 3.0
    along = np.linspace([0.1, 0.0], [0.9, 0.0], 20)
    x, y = np.rint(apply_homography(square_to_quad(shown.corners_px), along)).astype(int).T
    near = cv2.dilate(steps.edges.astype(np.uint8), np.ones((5, 5), np.uint8)) > 0
    assert near[y, x].all()
    assert len(steps.contours) >= len(steps.quads) > 0


@pytest.mark.parametrize("name", FAMILIES)
def test_the_shown_marker_is_the_detector_s(name: str) -> None:
    shown = rendered(name)
    seen = through(shown, name)
    (found,) = Detector([name]).detect(shown.grey, shown.camera)
    assert seen.shown is not None
    np.testing.assert_allclose(seen.shown.detection.corners_px, found.corners_px, atol=1e-9)
    assert seen.shown.family.name == name
    np.testing.assert_allclose(seen.shown.first_px, found.corners_px, atol=1.0)
    assert any(
        (seen.shown.first_px[0] == one).all() for one in seen.squares.corners_px.reshape(-1, 2)
    )


def test_the_largest_marker_is_shown() -> None:
    small, large = rendered(side_px=40.0), rendered(side_px=90.0)
    both = np.full((large.grey.shape[0], large.grey.shape[1] + small.grey.shape[1]), 200, np.uint8)
    both[: len(small.grey), : small.grey.shape[1]] = small.grey
    both[: len(large.grey), small.grey.shape[1] :] = large.grey
    seen = look_through(both, Detector())
    assert len(seen.findings.detections) == 2
    assert seen.shown is not None
    assert seen.shown.detection.side_px > 80


@pytest.mark.parametrize(
    "image",
    [
        np.full((8, 8), 100, np.uint8),
        np.zeros((9, 40, 3), np.uint8),
        np.random.default_rng(0).integers(0, 256, (64, 48), dtype=np.uint8),
        np.random.default_rng(0).integers(0, 65536, (33, 31, 3), dtype=np.uint16),
    ],
    ids=["plain", "black", "noise", "16 bits"],
)
def test_images_without_markers_go_through(image: np.ndarray) -> None:
    seen = look_through(image, Detector())
    assert seen.shown is None
    assert seen.grey.shape == image.shape[:2]
    assert seen.parted.is_dark.shape == seen.parted.grey.shape


def test_what_is_no_image_is_refused() -> None:
    with pytest.raises(InputError, match="too small to show a marker"):
        look_through(np.zeros((4, 4), np.uint8), Detector())

import numpy as np
import pytest

from tagmetry.camera import BrownLens, Camera, FisheyeLens
from tagmetry.detect.detection import Detection, Rejection
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pose.result import MarkerPose, PoseHypothesis
from tagmetry.record import draw_overlay
from tagmetry.record.drawing import MARGIN_PX, Pen, clip_segments, draw_path
from tagmetry.record.palette import AXES, DARK, ORANGE, PURPLE, SKY_BLUE, VERMILLION, WHITE, YELLOW
from tagmetry.record.wires import axis_wires, cube_wires

CAMERA = Camera(640, 480, (600.0, 600.0), (320.0, 240.0))
GREY = np.full((480, 640), 128, np.uint8)
FACING = Rotation.from_euler("x", np.pi)  # the marker's z towards the camera, its y up
SIZE_M = 0.2


def pose_at(translation_m, rotation=FACING) -> MarkerPose:
    T = RigidTransform.from_components(translation_m, rotation)
    return MarkerPose("tag36h11", 5, SIZE_M, (PoseHypothesis(T, np.eye(6), 0.1, 1.0, 1.0),))


def detection_of(pose: MarkerPose, number=5, family="tag36h11", covariance_px2=0.01) -> Detection:
    square = np.array([[-1, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]]) * SIZE_M / 2
    corners = CAMERA.project(pose.best.T_camera_marker.apply(square))
    return Detection(family, number, corners, np.eye(8) * covariance_px2, 0, 1.0)


POSE = pose_at([0.0, 0.0, 1.0])  # 120 px wide, from (260, 180) to (380, 300)
SEEN = detection_of(POSE)


def color_at(canvas, x: int, y: int) -> tuple[int, ...]:
    return tuple(canvas[y, x].tolist())


def has(canvas, color) -> bool:
    return bool((canvas == np.array(color)).all(axis=-1).any())


def is_like(found, color) -> bool:
    """Whether a pixel has a color, but for the smoothing of thin lines."""
    return bool(np.abs(found.astype(int) - color).max() < 60)


def test_the_outline_lies_on_the_corners_and_the_picture_stays_as_it_was() -> None:
    before = GREY.copy()
    canvas = draw_overlay(GREY, [SEEN])
    for x, y in [(320, 180), (380, 240), (320, 300), (260, 240)]:
        assert color_at(canvas, x, y) == SKY_BLUE
        inside = (round(0.9 * x + 32), round(0.9 * y + 24))
        assert color_at(canvas, *inside) == (128, 128, 128)
    np.testing.assert_array_equal(GREY, before)
    assert canvas.shape == (480, 640, 3)


def test_the_dot_is_at_the_markers_own_top_left() -> None:
    for turn in range(4):
        corners = np.roll(SEEN.corners_px, turn, axis=0)
        turned = Detection("tag36h11", 5, corners, SEEN.corners_cov_px2, 0, 1.0)
        canvas = draw_overlay(GREY, [turned])
        found = [color_at(canvas, *map(round, corner)) for corner in corners]
        assert found[0] == ORANGE
        assert ORANGE not in found[1:]


def test_a_line_lies_where_its_fractions_say() -> None:
    for x in (10.0, 10.25, 10.5, 10.75):
        canvas = np.zeros((40, 40, 3), np.uint8)
        draw_path(canvas, np.array([[x, -50.0], [x, 90.0]]), Pen(WHITE, 1, rim_px=0))
        weight = canvas[20, :, 0].astype(float)
        assert weight @ np.arange(40) / weight.sum() == pytest.approx(x, abs=0.1)


def test_axes_are_red_green_and_blue() -> None:
    tilted = pose_at([0.0, 0.0, 1.0], Rotation.from_euler("y", 0.6) * FACING)
    canvas = draw_overlay(GREY, [detection_of(tilted)], [tilted], CAMERA)
    T = tilted.best.T_camera_marker
    for axis, color in zip(np.eye(3) * SIZE_M / 2, AXES, strict=True):
        x, y = np.rint(CAMERA.project(T.apply(0.8 * axis))).astype(int)
        assert color_at(canvas, x, y) == color
        x, y = np.rint(CAMERA.project(T.apply(1.3 * axis))).astype(int)
        assert color_at(canvas, x, y) != color


def test_the_cube_stands_on_the_marker_towards_the_camera() -> None:
    canvas = draw_overlay(GREY, [SEEN], [POSE], CAMERA, cube=True, axes=False)
    # its lid is at depth 1.0 - 0.2, so it is 150 px wide: from (245, 165) to (395, 315)
    for x, y in [(320, 165), (395, 240), (245, 240)]:
        assert color_at(canvas, x, y) == YELLOW
    assert not has(draw_overlay(GREY, [SEEN], [POSE], CAMERA), YELLOW)


def test_edges_bend_with_the_lens() -> None:
    lens = BrownLens((-0.3, 0.0, 0.0, 0.0))
    camera = Camera(640, 480, (600.0, 600.0), (320.0, 240.0), lens)
    aside = pose_at([0.3, 0.2, 1.0])
    T = aside.best.T_camera_marker
    for wire in cube_wires(T, camera, SIZE_M):
        first, middle, last = wire.points_px[[0, 4, 8]]
        assert np.linalg.norm(middle - (first + last) / 2) > 0.01
    middle_m = T.apply(np.array([0.0, SIZE_M / 2, SIZE_M]))
    middles = [wire.points_px[4] for wire in cube_wires(T, camera, SIZE_M)]
    gaps = np.linalg.norm(middles - camera.project(middle_m), axis=1)
    assert gaps.min() == pytest.approx(0.0, abs=1e-9)


def test_the_nearest_edge_is_drawn_last() -> None:
    T = pose_at([0.0, 0.0, 1.0], Rotation.from_euler("y", 0.5) * FACING).best.T_camera_marker
    order = [wire.color for wire in axis_wires(T, CAMERA, SIZE_M)]
    tips = T.apply(np.eye(3) * SIZE_M / 2)
    nearest = AXES[int(np.argmin(np.linalg.norm(tips, axis=1)))]
    assert order[-1] == nearest


def test_ellipses_are_as_large_as_stated() -> None:
    canvas = draw_overlay(GREY, [SEEN], ellipse_magnification=200.0)  # 0.1 px -> 20 px
    for corner in np.rint(SEEN.corners_px).astype(int):
        outward = np.sign(corner - [320, 240])
        for x, y in corner + 20 * outward * np.eye(2, dtype=int):
            assert is_like(canvas[y, x], PURPLE)
            assert color_at(canvas, x, y - 9 * outward[1]) != PURPLE
    caption = canvas[460:, :200]
    assert has(caption, PURPLE)


@pytest.mark.parametrize("along", [(0.8, 0.6), (0.8, -0.6), (0.6, 0.8), (-0.6, 0.8)])
def test_ellipses_lie_along_the_uncertain_direction(along) -> None:
    along, across = np.array(along), np.array([-along[1], along[0]])
    block = 0.1**2 * np.outer(along, along) + 0.01**2 * np.outer(across, across)
    seen = Detection("f", 1, SEEN.corners_px, np.kron(np.eye(4), block), 0, 1.0)
    canvas = draw_overlay(GREY, [seen], ellipse_magnification=300.0)
    x, y = np.rint(SEEN.corners_px[1] + 30 * along).astype(int)
    assert is_like(canvas[y, x], PURPLE)
    x, y = np.rint(SEEN.corners_px[1] + 30 * along * [1, -1]).astype(int)
    assert color_at(canvas, x, y) == (128, 128, 128)


def test_rejected_ones_have_another_color_and_a_reason() -> None:
    corners = np.array([[100.0, 100], [200, 100], [200, 200], [100, 200]])
    silent = draw_overlay(GREY, [], rejections=[Rejection(corners, "")])
    canvas = draw_overlay(GREY, [], rejections=[Rejection(corners, "too blurred")])
    assert color_at(canvas, 150, 100) == VERMILLION
    assert not has(canvas, SKY_BLUE)
    assert (canvas[205:] != silent[205:]).any()


@pytest.mark.parametrize("shape", [(120, 160), (480, 640), (2160, 3840)])
@pytest.mark.parametrize("share", [0.02, 0.2])
def test_the_id_is_readable_on_any_picture(shape, share) -> None:
    side = share * shape[1]
    middle = np.array([shape[1] / 2, shape[0] / 2])
    corners = middle + side * np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
    canvas = draw_overlay(
        np.full(shape, 128, np.uint8), [Detection("f", 188, corners, np.eye(8), 0, 1.0)]
    )
    rows = (canvas == np.array(WHITE)).all(axis=-1).any(axis=1).nonzero()[0]
    assert np.ptp(rows) + 1 >= max(6, shape[0] / 120)
    assert has(canvas, DARK)


def test_the_family_is_named_where_there_are_two() -> None:
    other = detection_of(pose_at([0.3, 0.0, 1.0]), family="4x4_50")
    same = detection_of(pose_at([0.3, 0.0, 1.0]))
    two, one = (draw_overlay(GREY, [SEEN, second]) for second in (other, same))
    white = [(canvas == np.array(WHITE)).all(axis=-1).sum() for canvas in (one, two)]
    assert white[1] > 3 * white[0]


@pytest.mark.parametrize(
    "corners",
    [
        pytest.param([[-1e9, 5], [1e9, 5], [1e9, 1e9], [-1e9, 1e9]], id="huge"),
        pytest.param([[-1e308, 5], [1e308, 5], [1e308, 1e308], [-1e308, 1e308]], id="overflow"),
        pytest.param([[np.nan, 5], [10, 5], [10, 10], [5, 10]], id="one NaN"),
        pytest.param([[np.inf, np.nan]] * 4, id="nothing"),
        pytest.param([[3, 3]] * 4, id="a point"),
    ],
)
def test_corners_far_outside_do_no_harm(corners) -> None:
    seen = Detection("f", 1, np.array(corners, float), np.full((8, 8), np.nan), 0, 1.0)
    canvas = draw_overlay(GREY, [seen], ellipse_magnification=5.0)
    assert canvas.shape == (480, 640, 3)


def test_a_line_through_the_picture_shows_although_it_ends_far_away() -> None:
    canvas = np.zeros((40, 60, 3), np.uint8)
    draw_path(canvas, np.array([[-1e7, 20.0], [1e7, 20.0]]), Pen(WHITE))
    assert (canvas[20, 1:] > 200).all()


def test_clipping_keeps_points_on_the_line_and_drops_what_cannot_be_seen() -> None:
    rng = np.random.default_rng(0)
    segments = rng.uniform(-3000, 3000, (2000, 2, 2))
    along = np.linspace(0, 1, 4001)[:, None, None]
    points = segments[None, :, 0] * (1 - along) + segments[None, :, 1] * along
    inside = ((points >= -MARGIN_PX) & (points <= [300 + MARGIN_PX, 200 + MARGIN_PX])).all(axis=-1)
    for segment, seen in zip(segments, inside.T, strict=True):
        cut = clip_segments(segment[None], 300, 200)
        if seen.any():
            direction = segment[1] - segment[0]
            offsets = cut[0] - segment[0]
            normal = np.array([-direction[1], direction[0]]) / np.linalg.norm(direction)
            np.testing.assert_allclose(offsets @ normal, 0, atol=1e-9)
            length = np.linalg.norm(cut[0, 1] - cut[0, 0])
            expected = seen.mean() * np.linalg.norm(direction)
            assert length == pytest.approx(expected, abs=2 * np.linalg.norm(direction) / 2000)


@pytest.mark.parametrize("lens", [BrownLens(), FisheyeLens()])
def test_points_behind_the_camera_are_left_out(lens) -> None:
    camera = Camera(640, 480, (600.0, 600.0), (320.0, 240.0), lens)
    for depth_m in (-1.0, 0.0, 0.05, 0.15):
        near = pose_at([0.0, 0.0, depth_m])
        canvas = draw_overlay(GREY, [SEEN], [near], camera, cube=True)
        assert color_at(canvas, 260, 250) in (SKY_BLUE, YELLOW)


@pytest.mark.parametrize(
    ("pixels", "expected"),
    [
        (np.full((9, 9), 7, np.uint8), 7),
        (np.full((9, 9, 3), 7, np.uint8), 7),
        (np.full((9, 9, 4), 7, np.uint8), 7),
        (np.full((9, 9), 0xABCD, np.uint16), 0xAB),
        (np.full((9, 9, 3), 0xFFF, np.uint16), 0xFF),
        (np.full((9, 18), 7, np.uint8)[:, ::2], 7),
        (np.zeros((1, 1), np.uint8), 0),
        (np.zeros((1, 640), np.uint16), 0),
    ],
)
def test_any_picture_can_be_drawn_on(pixels, expected) -> None:
    pixels.setflags(write=False)
    canvas = draw_overlay(pixels, [])
    assert canvas.shape == (*pixels.shape[:2], 3)
    assert canvas.dtype == np.uint8
    assert canvas.flags.c_contiguous
    assert (canvas == expected).all()


def test_a_tiny_picture_takes_everything() -> None:
    pixels = np.zeros((1, 1), np.uint8)
    assert draw_overlay(pixels, [SEEN], ellipse_magnification=1.0).shape == (1, 1, 3)


@pytest.mark.parametrize(
    "pixels",
    [
        np.zeros((0, 5), np.uint8),
        np.zeros((5, 5, 2), np.uint8),
        np.zeros((5, 5), np.float64),
        np.zeros(5, np.uint8),
        "picture",
    ],
)
def test_refuses_what_is_no_picture(pixels) -> None:
    with pytest.raises(InputError, match="expected a grey or BGR picture"):
        draw_overlay(pixels, [])


def test_refuses_a_camera_of_another_size() -> None:
    with pytest.raises(InputError, match="belong to 640x480 images"):
        draw_overlay(GREY[:100], [SEEN], [POSE], CAMERA)


def test_refuses_poses_that_do_not_pair_up() -> None:
    with pytest.raises(InputError, match="expected 1 poses, one per marker, got 2"):
        draw_overlay(GREY, [SEEN], [POSE, None], CAMERA)


def test_a_marker_without_a_pose_has_no_axes() -> None:
    failed = MarkerPose("tag36h11", 5, SIZE_M, ())
    plain = draw_overlay(GREY, [SEEN])
    for poses in ([None], [failed], None):
        np.testing.assert_array_equal(draw_overlay(GREY, [SEEN], poses, CAMERA, cube=True), plain)

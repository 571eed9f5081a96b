"""What makes a view unfit, and hostile pictures."""

import cv2
import numpy as np
import pytest
from rendered_boards import picture

from tagmetry.calibrate.targets import (
    QualityLimits,
    RejectedView,
    ViewQuality,
    explain_board,
    find_board,
    view_quality,
)
from tagmetry.calibrate.view import BoardView, round_covariances
from tagmetry.errors import InputError
from tagmetry.files.board_text import parse_board

CHESSBOARD = parse_board("chessboard:9x6:25mm")
BOARDS = [
    CHESSBOARD,
    parse_board("charuco:8x6:30mm:20mm:5x5_100"),
    parse_board("grid:4x3:50mm:14mm:6x6_250"),
    parse_board("aprilgrid:4x3:50mm:0.3"),
    parse_board("circles:7x5:30mm:16mm"),
]
NO_LIMITS = QualityLimits(np.inf, np.inf, np.inf, np.inf, 0.0)


def quality_of(pixels: np.ndarray) -> ViewQuality:
    view = find_board(pixels, CHESSBOARD, limits=NO_LIMITS)
    assert isinstance(view, BoardView), view.reason
    return view_quality(pixels, view)


def refused(pixels: np.ndarray) -> RejectedView:
    result = find_board(pixels, CHESSBOARD, source="a.png")
    assert isinstance(result, RejectedView)
    assert result.source == "a.png"
    return result


def shifted(pixels: np.ndarray, length_px: int, angle_deg: float) -> np.ndarray:
    """Return a picture taken while the camera moved."""
    kernel = np.zeros((length_px, length_px), np.float32)
    kernel[length_px // 2] = 1.0 / length_px
    turn = cv2.getRotationMatrix2D(((length_px - 1) / 2,) * 2, angle_deg, 1.0)
    kernel = cv2.warpAffine(kernel, turn, (length_px, length_px))
    return cv2.filter2D(pixels, -1, kernel / kernel.sum())


@pytest.mark.parametrize("blur_px", [1.0, 2.0, 3.0])
def test_the_blur_is_that_of_the_optics(blur_px: float) -> None:
    found = quality_of(picture(CHESSBOARD, spacing_px=34.0, blur_px=blur_px).pixels)
    true_px = np.hypot(blur_px, 1 / np.sqrt(12))
    assert found.blur_px == pytest.approx(true_px, rel=0.2)
    assert found.sharp_px == pytest.approx(true_px, rel=0.2)


def test_the_contrast_and_the_spacing_are_those_of_the_board() -> None:
    found = quality_of(picture(CHESSBOARD, spacing_px=30.0, tilt_deg=0.0).pixels)
    assert found.contrast == pytest.approx((0.85 - 0.06) * 255, abs=8)
    assert found.spacing_px == pytest.approx(30.0, abs=3)
    assert found.saturated_share == 0
    assert not found.touches_border


def test_a_point_near_the_edge_is_said() -> None:
    shown = picture(CHESSBOARD, spacing_px=30.0)
    low_px = np.floor(shown.truth_px.min(axis=0)).astype(int) - 4
    cut = np.ascontiguousarray(shown.pixels[:, low_px[0] :])
    view = BoardView(
        cut.shape[1], cut.shape[0], np.arange(54), CHESSBOARD.corners_m,
        shown.truth_px - [low_px[0], 0], round_covariances(np.full(54, 0.1)),
    )  # fmt: skip
    assert view_quality(cut, view).touches_border


def test_a_blurred_view_is_refused() -> None:
    pixels = picture(CHESSBOARD, spacing_px=26.0, blur_px=5.0).pixels
    assert "blurred by 4.4 px where corners are 2" in refused(pixels).reason


def test_a_view_taken_in_motion_is_refused() -> None:
    still = picture(CHESSBOARD, spacing_px=34.0, roll_deg=0.0, tilt_deg=5.0)
    reason = refused(shifted(still.pixels, 11, 0.0)).reason
    assert "moved: edges of one direction are blurred by" in reason
    assert isinstance(find_board(still.pixels, CHESSBOARD), BoardView)


def test_a_clipped_view_is_refused() -> None:
    shown = picture(CHESSBOARD, spacing_px=28.0).pixels.astype(float)
    clipped = np.clip((shown - 120) * 20 + 120, 0, 255).astype(np.uint8)
    assert "clipped: " in refused(clipped).reason


def test_a_flat_view_is_refused_with_what_was_seen() -> None:
    shown = picture(CHESSBOARD, noise=0.3, brightness=0.06)
    findings = explain_board(shown.pixels, CHESSBOARD)
    assert isinstance(findings.result, RejectedView)
    assert "too little contrast" in findings.result.reason
    assert len(findings.result.seen_px) > 40
    assert findings.quality is not None


@pytest.mark.parametrize(
    ("limits", "reason"),
    [
        (QualityLimits(blur_share=0.01), "come closer"),
        (QualityLimits(contrast=250.0), "contrast"),
        (QualityLimits(saturated_share=-1.0), "clipped"),
        (QualityLimits(motion_ratio=0.5, motion_px=0.1), "moved"),
    ],
)
def test_a_limit_is_kept(limits: QualityLimits, reason: str) -> None:
    result = find_board(picture(CHESSBOARD).pixels, CHESSBOARD, limits=limits)
    assert isinstance(result, RejectedView)
    assert reason in result.reason


@pytest.mark.parametrize("board", BOARDS)
def test_a_picture_without_a_board_has_a_reason(board: object) -> None:
    rng = np.random.default_rng(0)
    hostile = [
        np.zeros((1, 1), np.uint8),
        np.zeros((7, 5000), np.uint8),
        np.full((64, 48), 130, np.uint8),
        np.full((64, 48, 3), 65535, np.uint16),
        rng.integers(0, 256, (120, 160), dtype=np.uint8),
        rng.integers(0, 65536, (90, 70, 3), dtype=np.uint16),
        np.kron(np.indices((12, 16)).sum(axis=0) % 2, np.ones((8, 8))).astype(np.uint8) * 255,
        np.zeros((8, 8), np.uint8),
    ]
    for pixels in hostile:
        result = find_board(pixels, board, source="x")
        assert isinstance(result, RejectedView)
        assert result.reason


def test_a_huge_picture_is_searched() -> None:
    shown = picture(CHESSBOARD, spacing_px=24.0)
    large = cv2.resize(shown.pixels, None, fx=12, fy=12, interpolation=cv2.INTER_CUBIC)
    view = find_board(large, CHESSBOARD)
    assert isinstance(view, BoardView)
    expected = (shown.truth_px + 0.5) * 12 - 0.5
    assert np.abs(view.corners_px - expected).max() < 2.0


@pytest.mark.parametrize(
    ("pixels", "text"),
    [
        ("a picture", "must be a NumPy array"),
        (np.zeros((20, 20, 7), np.uint8), "must have shape"),
        (np.zeros((20, 20)), "must hold uint8 or uint16"),
    ],
)
def test_refuses_what_is_no_image(pixels: object, text: str) -> None:
    with pytest.raises(InputError, match=text):
        find_board(pixels, CHESSBOARD)


def test_refuses_a_board_that_it_cannot_find() -> None:
    with pytest.raises(InputError, match="no finder for a board of type object"):
        find_board(np.zeros((20, 20), np.uint8), object())

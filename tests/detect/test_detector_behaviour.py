"""What holds of every picture: families, turns, order, forgiven bits, refused settings."""

import numpy as np
import pytest
from drawn_markers import board, named
from rendered_markers import only, scene

from tagmetry.detect import Detector
from tagmetry.errors import InputError
from tagmetry.markers import family
from tagmetry.twin import Look

MIXED = board(("tag36h11", 5), ("4x4_50", 3), ("6x6_250", 77), ("aruco_original", 45))

FAMILIES = ("tag36h11", "4x4_50", "6x6_250", "aruco_original")


def test_several_families_in_one_pass_are_the_union_of_single_passes() -> None:
    together = Detector(FAMILIES).detect(MIXED)
    apart = [d for name in FAMILIES for d in Detector([name]).detect(MIXED)]
    assert named(together) == sorted(named(tuple(apart)))
    assert len(together) == 4
    for a, b in zip(together, sorted(apart, key=lambda d: (d.family, d.id)), strict=True):
        np.testing.assert_allclose(a.corners_px, b.corners_px, atol=1e-6)


def test_a_marker_of_two_overlapping_families_is_found_once() -> None:
    picture = board(("4x4_50", 9))
    assert named(Detector(["4x4_50", "4x4_100"]).detect(picture)) == [("4x4_50", 9)]
    assert named(Detector(["4x4_100", "4x4_50"]).detect(picture)) == [("4x4_100", 9)]


def test_inverted_markers_are_found_only_when_asked_for() -> None:
    negative = 255 - board(("4x4_50", 9))
    assert Detector(["4x4_50"]).detect(negative) == ()
    found = only(Detector(["4x4_50"], inverted=True).detect(negative))
    upright = only(Detector(["4x4_50"]).detect(255 - negative))
    assert found.is_inverted
    assert not upright.is_inverted
    np.testing.assert_allclose(found.corners_px, upright.corners_px, atol=0.02)


@pytest.mark.parametrize("quarters", [1, 2, 3])
def test_turning_the_picture_turns_the_corners(quarters: int) -> None:
    """Not quite exactly: passes resize and rounds differ, and fits end within a thousandth.

    The camera is known: else one turn may just believe a bow that the other does not.
    """
    shown = scene(np.random.default_rng(1), 50.0, tilt_deg=30.0)
    side_px = shown.grey.shape[0] - 1
    upright = only(Detector().detect(shown.grey, shown.camera))
    turned = only(Detector().detect(np.rot90(shown.grey, -quarters), shown.camera))
    expected = upright.corners_px
    for _ in range(quarters):  # clockwise: x' = side - y, y' = x
        expected = np.stack([side_px - expected[:, 1], expected[:, 0]], axis=1)
    np.testing.assert_allclose(turned.corners_px, expected, atol=0.005)


def test_a_mirrored_print_is_no_marker() -> None:
    """Of the original ArUco markers some are others' mirror images: 45 reads as 480."""
    assert Detector(["tag36h11", "4x4_50", "6x6_250"]).detect(np.fliplr(MIXED)) == ()


def test_results_are_in_order_and_repeat_exactly() -> None:
    first, second = Detector(FAMILIES).detect(MIXED), Detector(FAMILIES).detect(MIXED)
    assert named(first) == sorted(named(first))
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a.corners_px, b.corners_px)
        np.testing.assert_array_equal(a.corners_cov_px2, b.corners_cov_px2)


def test_what_is_turned_down_comes_with_its_reason() -> None:
    findings = Detector(["tag36h11"]).explain(board(("6x6_250", 77)))
    assert findings.detections == ()
    assert any("wrong bits" in r.reason for r in findings.rejections)
    inverted = Detector().explain(255 - board(("tag36h11", 5)))
    assert any("white on black" in r.reason for r in inverted.rejections)


def test_wrong_bits_are_forgiven_up_to_a_number() -> None:
    cells = np.pad(family("tag36h11").picture(5), 2, constant_values=True)
    for flipped in ((4, 4), (6, 7)):
        cells[flipped] ^= True
    picture = np.asarray(np.kron(cells, np.ones((8, 8))) * 180 + 40, dtype=np.uint8)
    assert only(Detector(forgive_bits=2).detect(picture)).hamming == 2
    assert only(Detector().detect(picture)).id == 5
    assert Detector(forgive_bits=1).detect(picture) == ()


def test_a_covariance_is_symmetric_and_positive() -> None:
    for found in Detector(FAMILIES).detect(MIXED):
        np.testing.assert_allclose(found.corners_cov_px2, found.corners_cov_px2.T, atol=1e-12)
        assert np.linalg.eigvalsh(found.corners_cov_px2).min() > 0


def test_settings_are_refused_in_words() -> None:
    with pytest.raises(InputError, match="at least one marker family"):
        Detector([])
    with pytest.raises(InputError, match="tag36h12"):
        Detector(["tag36h12"])
    with pytest.raises(InputError, match="forgive_bits must be 0 or more, got -1"):
        Detector(forgive_bits=-1)
    for side_px in (0.0, np.nan, np.inf):
        with pytest.raises(InputError, match="min_side_px must be at least 4"):
            Detector(min_side_px=side_px)


def test_dim_and_flat_light_are_enough() -> None:
    """Forty grey values between black and white, light falling off by half across the marker."""
    shown = scene(np.random.default_rng(3), 60.0, look=Look(black=60.0, white=100.0, noise=1.0))
    fall_off = np.linspace(0.6, 1.2, shown.grey.shape[1])
    picture = np.asarray(shown.grey * fall_off, dtype=np.uint8)
    assert only(Detector().detect(picture)).id == 7

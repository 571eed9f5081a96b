"""Each cause is made in a rendered picture and must be named; a good picture must get no advice."""

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tagmetry.camera import Camera
from tagmetry.detect.doctor import diagnose
from tagmetry.detect.doctor.edges import principal_blurs_px, side_blurs_px
from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.markers import MountedMarker, family
from tagmetry.twin.rendering import Look, render

CAMERA = Camera(640, 480, (600.0, 600.0), (319.5, 239.5))
FACING = Rotation.from_matrix(np.diag([1.0, -1.0, -1.0]))
SIZE_M = 0.1


def picture(side_px=100, name="tag36h11", ids=(8,), turn_deg=20.0, **look):
    T = RigidTransform.from_components(
        [0, 0, CAMERA.focal_px[0] * SIZE_M / side_px],
        FACING * Rotation.from_euler("z", turn_deg, degrees=True),
    )
    left_m = -0.15 * (len(ids) - 1) / 2
    markers = [
        MountedMarker(name, one, SIZE_M, RigidTransform.from_translation([left_m + 0.15 * n, 0, 0]))
        for n, one in enumerate(ids)
    ]
    return render(markers, T, CAMERA, np.random.default_rng(0), Look(**look))


def asked(image, *names):
    return diagnose(image, [family(name) for name in names])


def titles(advice):
    return [(one.severity, one.title) for one in advice]


FOUND = [("ok", "found")]


@pytest.mark.parametrize("names", [("tag36h11",), ("4x4_50", "tag36h11"), ()])
def test_a_good_picture_gets_no_advice(names) -> None:
    advice = asked(picture(), *names)
    assert titles(advice) == FOUND
    assert advice[0].explanation == "tag36h11 id 8, sides of 100 px"


@pytest.mark.parametrize(
    ("printed", "ids", "wanted", "named"),
    [
        ("4x4_50", (1, 2, 3), "tag36h11", "4x4_50 ids 1, 2, 3"),
        ("4x4_1000", (100, 202, 203), "tag36h11", "4x4_250 ids 100, 202, 203"),
        ("aruco_original", (3, 7), "tag36h11", "aruco_original ids 3, 7"),
        ("tag36h11", (3,), "6x6_250", "tag36h11 id 3"),
    ],
)
def test_names_the_smallest_family_that_is_there(printed, ids, wanted, named) -> None:
    advice = asked(picture(name=printed, ids=ids), wanted)
    assert titles(advice) == [("problem", "another family")]
    assert advice[0].explanation == f"{named} in the picture; asked for was {wanted}"
    assert advice[0].remedy == f"--family {named.split()[0]}"


def test_one_small_code_is_named_as_uncertain() -> None:
    advice = asked(picture(name="4x4_50", ids=(7,)), "tag36h11")
    assert ("hint", "perhaps a marker") in titles(advice)
    assert ("problem", "another family") not in titles(advice)


@pytest.mark.parametrize(
    ("printed", "wanted"),
    [("tag36h11_border2", "tag36h11"), ("tag36h11", "tag36h11_border2")],
)
def test_names_a_border_of_another_width(printed, wanted) -> None:
    advice = asked(picture(name=printed), wanted)
    assert titles(advice) == [("problem", "another width of border")]
    assert advice[0].remedy.startswith(f"--family {printed};")


@pytest.mark.parametrize("names", [("tag36h11",), ()])
def test_inverted_print(names) -> None:
    advice = asked(255 - picture(), *names)
    assert titles(advice) == [("problem", "inverted print")]
    assert advice[0].explanation == "tag36h11 id 8 printed white on black"


@pytest.mark.parametrize("names", [("tag36h11",), ()])
def test_mirror_image(names) -> None:
    advice = asked(picture()[:, ::-1], *names)
    assert titles(advice) == [("problem", "mirror image")]
    assert advice[0].explanation.startswith("tag36h11 id 8 found only after")


def test_too_small() -> None:
    advice = asked(picture(side_px=8.5, ids=(7,)), "tag36h11")
    assert titles(advice) == [("problem", "too small")]
    assert "sides of 9 px, 1.1 px per cell" in advice[0].explanation


def test_small_markers_that_are_still_found() -> None:
    advice = asked(picture(side_px=16), "tag36h11")
    assert titles(advice) == [("hint", "small markers"), *FOUND]
    assert "the smallest 2.0" in advice[0].explanation


def test_too_dark_is_proven_by_stretching() -> None:
    dark = (picture() * 0.03 + 2).astype(np.uint8)
    advice = asked(dark, "tag36h11")
    assert titles(advice) == [("problem", "too dark")]
    assert "stretched to full contrast: tag36h11 id 8" in advice[0].explanation


@pytest.mark.parametrize(("grey", "title"), [(0, "too dark"), (255, "too bright")])
def test_an_even_picture(grey, title) -> None:
    advice = asked(np.full((480, 640), grey, np.uint8), "tag36h11")
    assert titles(advice) == [("problem", "no marker-like squares"), ("hint", title)]
    assert f"from {grey} to {grey}" in advice[1].explanation


def test_a_small_marker_in_a_plain_picture_is_not_called_flat() -> None:
    assert "too little contrast" not in dict(titles(asked(picture(side_px=8), "tag36h11"))).values()


def test_out_of_focus() -> None:
    found = asked(picture(side_px=120, blur_px=4), "tag36h11")
    assert titles(found) == [("hint", "soft edges"), *FOUND]
    assert "out of focus" in found[0].explanation
    lost = asked(picture(side_px=120, blur_px=20), "tag36h11")
    assert ("hint", "blurred") in titles(lost)


def test_motion_blurs_one_way() -> None:
    moved = cv2.blur(picture(side_px=120, turn_deg=0), (13, 1))
    advice = asked(moved, "tag36h11")
    assert titles(advice) == [("hint", "soft edges"), *FOUND]
    assert "something moved" in advice[0].explanation


def test_dark_ground_up_to_the_border() -> None:
    advice = asked(picture(quiet_cells=0, background=30), "tag36h11")
    assert titles(advice) == [("problem", "no quiet zone")]
    assert "tag36h11 id 8" in advice[0].explanation
    assert advice[0].explanation.endswith("what lies around is too dark")


def test_a_quiet_zone_cut_off_by_the_edge_does_no_harm() -> None:
    upright = picture(ids=(7,), turn_deg=0)
    advice = asked(upright[193:], "tag36h11")
    assert titles(advice) == [("hint", "at the image's edge"), *FOUND]


def test_a_marker_found_at_the_edge_may_be_cut() -> None:
    advice = asked(picture(turn_deg=0)[194:], "tag36h11")
    assert titles(advice) == [("hint", "at the image's edge"), *FOUND]


def test_wrong_bits_are_counted() -> None:
    dirty = picture(ids=(7,))
    dirty[225:265, 290:330] = 30
    advice = asked(dirty, "tag36h11")
    assert titles(advice) == [("problem", "wrong bits")]
    assert "probably tag36h11 id 7 with 5 wrong bits; 3 are forgiven" in advice[0].explanation


def test_an_id_twice() -> None:
    advice = asked(picture(ids=(3, 3)), "tag36h11")
    assert titles(advice) == [("hint", "an id more than once"), *FOUND]
    assert "id 3 (2 times)" in advice[0].explanation


def test_noise_is_no_marker() -> None:
    noise = np.random.default_rng(0).integers(0, 256, (240, 320)).astype(np.uint8)
    assert titles(diagnose(noise)) == [("problem", "no marker-like squares")]


@pytest.mark.parametrize("shape", [(1, 1), (0, 5), (1, 640)])
def test_refuses_what_cannot_show_a_marker(shape) -> None:
    with pytest.raises(InputError, match="too small to show a marker"):
        diagnose(np.zeros(shape, np.uint8))


@pytest.mark.parametrize("blur_px", [1.0, 2.0, 3.0])
def test_the_blur_of_an_edge_is_its_standard_deviation(blur_px) -> None:
    sharp = np.full((120, 120), 220.0)
    sharp[30:90, 30:90] = 20
    grey = np.rint(cv2.GaussianBlur(sharp, (0, 0), blur_px)).astype(np.uint8)
    corners = np.array([[29.5, 29.5], [89.5, 29.5], [89.5, 89.5], [29.5, 89.5]])
    np.testing.assert_allclose(side_blurs_px(grey, corners, 15), blur_px, rtol=0.05, atol=0.12)


def test_principal_blurs_of_turned_squares() -> None:
    angle = np.deg2rad([10, 100, 50, 140, 75])
    normals = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    along = np.array([np.cos(0.6), np.sin(0.6)])
    S = 2.0**2 * np.eye(2) + (5.0**2 - 2.0**2) * np.outer(along, along)
    blurs = np.sqrt(np.einsum("ni,ij,nj->n", normals, S, normals))
    np.testing.assert_allclose(principal_blurs_px(blurs, normals), (5.0, 2.0), rtol=1e-9)


def test_one_square_equally_blurred_is_not_called_moved() -> None:
    angle = np.deg2rad([20, 110, 200, 290])
    normals = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    np.testing.assert_allclose(principal_blurs_px(np.full(4, 3.0), normals), (3.0, 3.0))

"""Markers on a body: where their corners are, and which way they face."""

import numpy as np
import pytest

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import MarkerBody, MountedMarker, cube, marker_corners_m

OUTWARD = {
    0: [0, -1, 0],
    1: [1, 0, 0],
    2: [0, 1, 0],
    3: [-1, 0, 0],
    4: [0, 0, 1],
    5: [0, 0, -1],
}
CUBE = cube("die", 0.06, 0.05, "tag36h11", range(6))


def test_corners_go_clockwise_from_the_top_left() -> None:
    expected = [[-0.1, 0.1, 0], [0.1, 0.1, 0], [0.1, -0.1, 0], [-0.1, -0.1, 0]]
    np.testing.assert_allclose(marker_corners_m(0.2), expected)


def test_corners_of_many_sizes() -> None:
    sizes_m = np.array([[0.1, 0.2, 0.3]])
    found = marker_corners_m(sizes_m)
    assert found.shape == (1, 3, 4, 3)
    np.testing.assert_allclose(found[0, 2], marker_corners_m(0.3))


def test_a_mounted_marker_s_corners_are_in_the_body_s_frame() -> None:
    T_body_marker = RigidTransform.from_components(
        [1.0, 2.0, 3.0], Rotation.from_euler("z", 90, degrees=True)
    )
    found = MountedMarker("tag36h11", 4, 0.2, T_body_marker).corners_m
    expected = [[0.9, 1.9, 3], [0.9, 2.1, 3], [1.1, 2.1, 3], [1.1, 1.9, 3]]
    np.testing.assert_allclose(found, expected)


@pytest.mark.parametrize("face", range(6))
def test_a_cube_s_faces_look_outward(face: int) -> None:
    corners = CUBE.corners_m["tag36h11", face]
    to_the_right, to_the_top = corners[1] - corners[0], corners[0] - corners[3]
    normal = np.cross(to_the_right, to_the_top) / 0.05**2
    np.testing.assert_allclose(normal, OUTWARD[face], atol=1e-12)
    np.testing.assert_allclose(corners.mean(axis=0), 0.03 * np.array(OUTWARD[face]), atol=1e-12)


@pytest.mark.parametrize("face", range(6))
def test_a_cube_s_faces_are_upright(face: int) -> None:
    """Sides have their top towards +z; the top's points to the back, the bottom's to the front."""
    top = {4: [0, 1, 0], 5: [0, -1, 0]}.get(face, [0, 0, 1])
    corners = CUBE.corners_m["tag36h11", face]
    np.testing.assert_allclose((corners[0] - corners[3]) / 0.05, top, atol=1e-12)


@pytest.mark.parametrize("face", range(6))
def test_a_cube_s_markers_are_not_mirrored(face: int) -> None:
    R = CUBE.markers[face].T_body_marker.rotation.as_matrix()
    assert np.linalg.det(R) == pytest.approx(1.0)


def test_a_bare_face_has_no_marker() -> None:
    body = cube("roof", 0.1, 0.1, "4x4_50", [None, None, 7, None, 3, None])
    assert list(body.corners_m) == [("4x4_50", 7), ("4x4_50", 3)]
    np.testing.assert_allclose(body.corners_m["4x4_50", 7][:, 1], 0.05)
    np.testing.assert_allclose(body.corners_m["4x4_50", 3][:, 2], 0.05)


def test_refuses_the_same_marker_twice() -> None:
    with pytest.raises(InputError, match="body 'die' has tag36h11 id 3 twice"):
        cube("die", 0.06, 0.05, "tag36h11", [0, 3, 1, 3, 2, 4])


def test_the_same_id_of_two_families_are_two_markers() -> None:
    at = RigidTransform.identity()
    body = MarkerBody(
        "two", (MountedMarker("tag36h11", 1, 0.1, at), MountedMarker("tag25h9", 1, 0.1, at))
    )
    assert len(body.corners_m) == 2


def test_refuses_another_number_of_faces() -> None:
    with pytest.raises(InputError, match="a cube has six faces, got 5 ids"):
        cube("die", 0.06, 0.05, "tag36h11", range(5))


@pytest.mark.parametrize(
    ("side_m", "size_m"), [(0.05, 0.06), (0.05, 0.0), (0.05, -1.0), (np.nan, 0.1), (np.inf, np.inf)]
)
def test_refuses_a_marker_that_does_not_fit_the_face(side_m: float, size_m: float) -> None:
    with pytest.raises(InputError, match="does not fit a cube's face"):
        cube("die", side_m, size_m, "tag36h11", range(6))

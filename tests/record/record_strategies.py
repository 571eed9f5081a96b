"""Random results, and the comparison of two of them."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from tagmetry.detect.detection import Detection
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.transforms import Rotation
from tagmetry.pose.result import MarkerPose, PoseHypothesis
from tagmetry.record import ImageResult, MarkerResult

known = st.floats(allow_nan=False, allow_infinity=False)
unknown_too = st.one_of(known, st.just(float("nan")))


def matrices(rows: int, columns: int) -> st.SearchStrategy:
    return arrays(np.float64, (rows, columns), elements=unknown_too)


@st.composite
def transforms(draw) -> RigidTransform:
    axis = draw(arrays(np.float64, 3, elements=st.floats(-3, 3)))
    moved = draw(arrays(np.float64, 3, elements=st.floats(-1e6, 1e6)))
    return RigidTransform.from_components(moved, Rotation.from_rotvec(axis))


hypotheses = st.builds(
    PoseHypothesis, transforms(), matrices(6, 6), unknown_too, unknown_too, unknown_too
)


@st.composite
def markers(draw) -> MarkerResult:
    seen = Detection(
        draw(st.text(max_size=8)),
        draw(st.integers(0, 2**63 - 1)),
        draw(matrices(4, 2)),
        draw(matrices(8, 8)),
        draw(st.integers(0, 9)),
        draw(unknown_too),
        *draw(st.tuples(st.booleans(), st.booleans(), st.booleans())),
    )
    found = tuple(draw(st.lists(hypotheses, max_size=2)))
    pose = MarkerPose(seen.family, seen.id, draw(unknown_too), found)
    return MarkerResult(seen, draw(st.sampled_from([None, pose])))


results = st.builds(
    ImageResult,
    st.text(max_size=8),
    st.integers(0, 2**63 - 1),
    known,
    st.sampled_from(["capture", "arrival", "none"]),
    st.integers(1, 2**31 - 1),
    st.integers(1, 2**31 - 1),
    st.lists(markers(), max_size=2).map(tuple),
)


def assert_same(found: ImageResult, expected: ImageResult) -> None:
    """Compare all numbers for equality; only rotations pass through a quaternion."""
    head = ("source", "sequence", "time_s", "time_kind", "width_px", "height_px")
    assert [getattr(found, name) for name in head] == [getattr(expected, name) for name in head]
    assert len(found.markers) == len(expected.markers)
    for one, other in zip(found.markers, expected.markers, strict=True):
        _assert_same_fields(one.detection, other.detection)
        assert (one.pose is None) == (other.pose is None)
        if one.pose is not None:
            np.testing.assert_equal(one.pose.size_m, other.pose.size_m)
            assert len(one.pose.hypotheses) == len(other.pose.hypotheses)
            for a, b in zip(one.pose.hypotheses, other.pose.hypotheses, strict=True):
                _assert_same_hypothesis(a, b)


def _assert_same_hypothesis(found: PoseHypothesis, expected: PoseHypothesis) -> None:
    a, b = found.T_camera_marker, expected.T_camera_marker
    np.testing.assert_array_equal(a.translation, b.translation)
    np.testing.assert_allclose(a.rotation.as_matrix(), b.rotation.as_matrix(), atol=1e-14)
    _assert_same_fields(found, expected, leave="T_camera_marker")


def _assert_same_fields(found: object, expected: object, leave: str = "") -> None:
    for name in found.__dataclass_fields__:
        if name != leave:
            np.testing.assert_equal(getattr(found, name), getattr(expected, name))

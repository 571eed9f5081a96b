"""Camera files: what is written reads back, what is damaged is read or refused."""

import contextlib
from pathlib import Path

import numpy as np
import pytest
from camera_examples import FULL, KALIBR, OPENCV, ROS, assert_equal
from hypothesis import given, settings
from hypothesis import strategies as st

from tagmetry.camera import BrownLens, Camera, FisheyeLens, Lens
from tagmetry.errors import InputError
from tagmetry.files import CameraFormat, load_camera, save_camera
from tagmetry.files.camera import _camera, _text
from tagmetry.files.tables import parse_table

FINITE = st.floats(allow_nan=False, allow_infinity=False)
POSITIVE = st.floats(min_value=1e-300, allow_infinity=False)
TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=30)


def lenses(*counts: int) -> st.SearchStrategy[Lens]:
    brown = [st.tuples(*[FINITE] * count).map(BrownLens) for count in counts]
    return st.one_of(*brown, st.tuples(*[FINITE] * 4).map(FisheyeLens))


@st.composite
def cameras(draw: st.DrawFn, *counts: int) -> Camera:
    lens = draw(lenses(*counts))
    size = 4 + len(lens.coefficients)
    half = np.random.default_rng(draw(st.integers(0, 1000))).normal(size=(size, size))
    return Camera(
        draw(st.integers(1, 50_000)),
        draw(st.integers(1, 50_000)),
        draw(st.tuples(POSITIVE, POSITIVE)),
        draw(st.tuples(FINITE, FINITE)),
        lens,
        covariance=draw(st.sampled_from([None, half @ half.T])),
        zoom=draw(POSITIVE),
        focus=draw(st.none() | FINITE),
        name=draw(TEXTS),
        provenance=draw(TEXTS),
    )


@given(cameras(0, 4, 5, 8, 12, 14))
@pytest.mark.parametrize(("form", "suffix"), [("ros", ""), ("opencv", ""), ("opencv", ".json")])
def test_camera_reads_back_exactly(form: CameraFormat, suffix: str, camera: Camera) -> None:
    assert_equal(_camera(parse_table(_text(camera, form, suffix)), None), camera)


@given(cameras(0, 4))
def test_kalibr_camera_reads_back_exactly(camera: Camera) -> None:
    assert_equal(_camera(parse_table(_text(camera, "kalibr", "")), None), camera)


@pytest.mark.parametrize("form", ["ros", "opencv", "kalibr"])
def test_file_reads_back(tmp_path: Path, form: CameraFormat) -> None:
    save_camera(FULL, tmp_path / "cam.yaml", form)
    assert_equal(load_camera(tmp_path / "cam.yaml"), FULL)


def _mutated(draw: st.DrawFn, text: str) -> str:
    for _ in range(draw(st.integers(1, 4))):
        start = draw(st.integers(0, len(text)))
        length = draw(st.integers(0, 12))
        patch = draw(
            st.text(max_size=4)
            | st.sampled_from(["[", "}", "- ", "&a ", "*a", "!!x ", "1e999", ".nan", "-", "null"])
        )
        text = text[:start] + patch + text[start + length :]
    return text


@given(st.data())
@settings(max_examples=400)
def test_damaged_file_is_read_or_refused(data: st.DataObject) -> None:
    text = data.draw(st.composite(_mutated)(data.draw(st.sampled_from([ROS, KALIBR, OPENCV]))))
    with contextlib.suppress(InputError):
        assert _camera(parse_table(text), None).width_px >= 1

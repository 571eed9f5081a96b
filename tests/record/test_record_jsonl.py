import io
import json
import os
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from record_strategies import assert_same, results

from tagmetry.camera.image import Image
from tagmetry.errors import InputError
from tagmetry.record import (
    CutLineWarning,
    ImageResult,
    format_line,
    open_writer,
    parse_line,
    read_results,
)

ROOT_HALF = 0.7071067811865476


@settings(max_examples=60, deadline=None)
@given(results)
def test_reading_gives_what_was_written(result) -> None:
    line = format_line(result)
    json.loads(line, parse_constant=lambda name: pytest.fail(f"{name} is no JSON"))
    assert "\n" not in line
    assert_same(parse_line(line), result)


@settings(max_examples=30, deadline=None)
@given(results)
def test_w_of_the_quaternion_is_not_negative(result) -> None:
    for marker in json.loads(format_line(result))["markers"]:
        assert all(pose["rotation_xyzw"][3] >= 0.0 for pose in marker.get("poses", []))


def test_a_line_is_the_contract(make_result) -> None:
    covariance = np.diag([1.0, 4.0, 9.0, 16.0, 25.0, 36.0]) * 1e-6
    pose = {
        "rotation_xyzw": [0.0, 0.0, ROOT_HALF, ROOT_HALF],
        "translation_m": [0.1, -0.2, 1.5],
        "covariance": covariance.tolist(),
        "reprojection_rms_px": 0.125,
        "probability": 0.75,
        "chi2": 3.0,
    }
    line = json.loads(format_line(make_result(3)))
    np.testing.assert_allclose(
        line["markers"][0]["poses"][0].pop("rotation_xyzw"), pose.pop("rotation_xyzw"), atol=1e-15
    )
    del line["markers"][0]["poses"][1]
    assert line == {
        "source": "video.mp4",
        "sequence": 3,
        "time_s": 0.1 * 3,
        "time_kind": "capture",
        "width": 640,
        "height": 480,
        "markers": [
            {
                "family": "tag36h11",
                "id": 7,
                "corners_px": [[10.0, 20.5], [30.25, 21.0], [29.0, 41.0], [9.5, 40.0]],
                "corners_cov_px2": (np.eye(8) * 0.01).tolist(),
                "hamming": 1,
                "confidence": 0.5,
                "is_inverted": False,
                "touches_border": False,
                "is_duplicate": False,
                "size_m": 0.12,
                "poses": [pose],
            }
        ],
    }


def test_poses_are_absent_where_none_was_asked_and_empty_where_there_is_none(
    make_result, make_pose
) -> None:
    unasked = make_result(posed=False)
    assert "poses" not in json.loads(format_line(unasked))["markers"][0]
    failed = replace(unasked.markers[0], pose=make_pose(count=0))
    line = json.loads(format_line(replace(unasked, markers=(failed,))))
    assert line["markers"][0]["poses"] == []


def test_a_line_with_the_promised_keys_only_is_read() -> None:
    marker = {"family": "4x4_50", "id": 1, "hamming": 0}
    marker |= {"corners_px": [[0, 0], [1, 0], [1, 1], [0, 1]], "corners_cov_px2": [[0] * 8] * 8}
    line = {"source": "a.png", "sequence": 0, "time_s": 0, "width": 2, "height": 2}
    result = parse_line(json.dumps(line | {"markers": [marker]}))
    assert (result.time_kind, result.markers[0].pose) == ("none", None)
    assert np.isnan(result.markers[0].detection.confidence)


def test_unknown_numbers_are_null_and_read_as_nan(make_result) -> None:
    result = make_result(posed=False)
    seen = replace(result.markers[0].detection, confidence=np.inf, corners_cov_px2=np.eye(8) / 0.3)
    seen.corners_cov_px2[0, 1] = np.nan
    line = format_line(replace(result, markers=(replace(result.markers[0], detection=seen),)))
    assert json.loads(line)["markers"][0]["corners_cov_px2"][0][1] is None
    assert np.isnan(parse_line(line).markers[0].detection.corners_cov_px2[0, 1])


def test_a_file_name_that_is_no_text_is_written_with_escapes(make_result) -> None:
    line = format_line(replace(make_result(), source=os.fsdecode(b"caf\xe9.png")))
    assert parse_line(line).source == r"caf\udce9.png"


def test_every_line_is_in_the_file_at_once(tmp_path, make_result) -> None:
    path = tmp_path / "out.jsonl"
    with open_writer(path) as writer:
        for number in range(3):
            writer.write(make_result(number))
            assert [found.sequence for found in read_results(path)] == list(range(number + 1))


def test_an_error_leaves_the_whole_lines(tmp_path, make_result) -> None:
    path = tmp_path / "out.jsonl"

    def failing_run() -> None:
        with open_writer(path) as writer:
            writer.write(make_result())
            raise RuntimeError

    with pytest.raises(RuntimeError):
        failing_run()
    assert len(list(read_results(path))) == 1


def test_a_minus_is_the_standard_output(monkeypatch, make_result) -> None:
    raw = io.BytesIO()
    stdout = io.TextIOWrapper(io.BufferedWriter(raw, 1 << 20))
    monkeypatch.setattr(sys, "stdout", stdout)
    with open_writer("-") as writer:
        writer.write(make_result(5))
        assert parse_line(raw.getvalue()).sequence == 5
    assert not stdout.closed


def test_half_a_line_at_the_end_is_passed_over_and_reported(tmp_path, make_result) -> None:
    path = tmp_path / "killed.jsonl"
    path.write_text(format_line(make_result(4)) + "\n" + format_line(make_result(5))[:100])
    with pytest.warns(CutLineWarning, match="line 2: passed over"):
        assert [found.sequence for found in read_results(path)] == [4]


def test_a_last_line_without_an_end_is_a_line(tmp_path, make_result) -> None:
    path = tmp_path / "out.jsonl"
    path.write_text(format_line(make_result(4)))
    assert [found.sequence for found in read_results(path)] == [4]


def test_a_line_without_end_is_not_read_into_memory(tmp_path, monkeypatch) -> None:
    path = tmp_path / "zeros.jsonl"
    path.write_bytes(bytes(5000))
    monkeypatch.setattr("tagmetry.record.jsonl.LONGEST_LINE_BYTES", 1000)
    with pytest.raises(InputError, match="line 1: Invalid JSON"):
        list(read_results(path))


@pytest.mark.parametrize(
    ("line", "complaint"),
    [
        pytest.param(b"", "EOF", id="empty"),
        pytest.param(b"\xff\xfe", "JSON", id="binary"),
        pytest.param(b"[" * 100_000, "recursion", id="deep"),
        pytest.param(b'{"source": "a"}', "sequence: Field required", id="missing key"),
        pytest.param(b'{"sequence": ' + b"9" * 5000 + b"}", "out of range", id="huge number"),
    ],
)
def test_a_damaged_line_gives_its_number(tmp_path, make_result, line, complaint) -> None:
    path = tmp_path / "damaged.jsonl"
    path.write_bytes(format_line(make_result()).encode() + b"\n" + line + b"\n")
    with pytest.raises(InputError, match=f"damaged.jsonl, line 2: .*{complaint}"):
        list(read_results(path))


@pytest.mark.parametrize(
    ("found", "put", "complaint"),
    [
        ('"width":640', '"width":0', "width: .*greater"),
        ('"id":7', '"id":-1', "markers.0.id"),
        ('"hamming":1', '"hamming":true', "hamming: .*integer"),
        ("[10.0,20.5]", "[10.0]", "corners_px.0"),
        ('"translation_m":[0.1', '"translation_m":[null', "translation_m.0"),
        ('"translation_m":[0.1', '"translation_m":[1e999', "finite"),
        ('"rotation_xyzw":[0.0', '"rotation_xyzw":[3.0', "quaternion of length 1"),
    ],
)
def test_a_wrong_value_is_named(make_result, found, put, complaint) -> None:
    line = format_line(make_result())
    assert found in line
    with pytest.raises(InputError, match=complaint):
        parse_line(line.replace(found, put))


def test_a_result_without_a_finite_time_is_refused(make_result) -> None:
    with pytest.raises(InputError, match="cannot be written: time_s"):
        format_line(replace(make_result(), time_s=np.nan))


def test_refuses_a_folder_that_is_not_there(tmp_path) -> None:
    with (
        pytest.raises(InputError, match=r"cannot write .*No such file"),
        open_writer(tmp_path / "a" / "b.jsonl"),
    ):
        pass


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="Linux only")  # noqa: PTH110
def test_a_full_disk_is_one_line(tmp_path, make_result) -> None:
    path = tmp_path / "full.jsonl"
    path.symlink_to("/dev/full")
    with pytest.raises(InputError, match=r"cannot write .*No space"), open_writer(path) as writer:
        writer.write(make_result())


def test_the_result_of_an_image_keeps_what_is_known_of_it(make_result, make_pose) -> None:
    image = Image(np.zeros((3, 4), np.uint8), 1.5, "arrival", 9, "cam")
    seen = make_result().markers[0].detection
    result = ImageResult.from_image(image, [seen], [None])
    assert (result.source, result.sequence, result.time_s, result.time_kind) == (
        ("cam", 9, 1.5, "arrival")
    )
    assert (result.width_px, result.height_px, result.markers[0].pose) == (4, 3, None)
    with pytest.raises(InputError, match="expected 1 poses, one per marker, got 2"):
        ImageResult.from_image(image, [seen], [make_pose(), None])

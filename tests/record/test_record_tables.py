import csv
import sys
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from record_strategies import assert_same, results

from tagmetry.errors import InputError, MissingExtraError
from tagmetry.geometry import RigidTransform
from tagmetry.record import open_writer, read_results
from tagmetry.record.parquet import BATCH_IMAGES
from tagmetry.record.table import COLUMNS

FINITE = ("out.csv", "out.parquet", "out.tum")


def write(path, *results_, **options) -> None:
    with open_writer(path, **options) as writer:
        for result in results_:
            writer.write(result)


def write_until(path, result, stop: BaseException) -> None:
    with open_writer(path) as writer:
        writer.write(result)
        raise stop


def read_csv(path) -> list[dict[str, str]]:
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
@given(st.lists(results, max_size=3))
def test_parquet_gives_what_was_written(tmp_path, written) -> None:
    path = tmp_path / "out.parquet"
    write(path, *written)
    for found, expected in zip(read_results(path), written, strict=True):
        assert_same(found, expected)


def test_parquet_is_typed_and_says_who_wrote_it(tmp_path, make_result) -> None:
    path = tmp_path / "out.parquet"
    write(path, make_result(), make_result(1, markers=()))
    table = pq.read_table(path)
    assert table.schema.metadata[b"poses"] == b"T_camera_marker"
    assert b"tagmetry" in table.schema.metadata
    assert str(table.schema.field("time_s").type) == "double"
    first, second = table.to_pylist()
    assert first["markers"][0]["corners_px"][1] == [30.25, 21.0]
    assert first["markers"][0]["poses"][0]["covariance"][5][5] == 36e-6
    assert second["markers"] == []


def test_parquet_of_many_batches(tmp_path, make_result) -> None:
    path = tmp_path / "out.parquet"
    write(path, *[make_result(n, posed=False) for n in range(2 * BATCH_IMAGES + 1)])
    assert [found.sequence for found in read_results(path)] == list(range(2 * BATCH_IMAGES + 1))


def test_csv_has_one_row_per_marker_with_units(tmp_path, make_result) -> None:
    path = tmp_path / "out.csv"
    write(path, make_result(2, (("tag36h11", 7), ("4x4_50", 3))), make_result(3, ()))
    rows = read_csv(path)
    assert [(row["family"], row["id"], row["sequence"]) for row in rows] == [
        ("tag36h11", "7", "2"),
        ("4x4_50", "3", "2"),
    ]
    expected = {"time_s": 0.2, "x1_px": 30.25, "y3_px": 40.0, "hamming": 1, "size_m": 0.12}
    expected |= {"x_m": 0.1, "y_m": -0.2, "z_m": 1.5, "qx": 0.0, "qz": 0.5**0.5, "qw": 0.5**0.5}
    expected |= {"sd_x_m": 1e-3, "sd_z_m": 3e-3, "sd_rx_rad": 4e-3, "sd_rz_rad": 6e-3}
    expected |= {"reprojection_rms_px": 0.125, "probability": 0.75, "ambiguity": 0.25}
    for name, value in expected.items():
        assert float(rows[0][name]) == pytest.approx(value, abs=1e-15), name


def test_csv_columns_all_have_a_place(tmp_path, make_result) -> None:
    path = tmp_path / "out.csv"
    write(path, make_result(), make_result(posed=False))
    for row in read_csv(path):
        assert tuple(row) == COLUMNS
        assert None not in row.values()


def test_csv_leaves_cells_empty_where_nothing_is_known(tmp_path, make_result, make_pose) -> None:
    path = tmp_path / "out.csv"
    unasked = make_result(posed=False)
    failed = replace(unasked.markers[0], pose=make_pose(count=0))
    vague = replace(unasked.markers[0].detection, confidence=np.nan)
    unknown = replace(unasked.markers[0], detection=vague)
    write(path, unasked, *(replace(unasked, markers=(m,)) for m in (failed, unknown)))
    first, second, third = read_csv(path)
    assert first["size_m"] == first["x_m"] == first["ambiguity"] == ""
    assert (second["size_m"], second["x_m"]) == ("0.12", "")
    assert third["confidence"] == ""


def test_csv_of_a_covariance_that_rounding_made_negative(tmp_path, make_result) -> None:
    image = make_result()
    best = replace(image.markers[0].pose.best, covariance=-1e-30 * np.eye(6))
    pose = replace(image.markers[0].pose, hypotheses=(best,))
    write(tmp_path / "out.csv", replace(image, markers=(replace(image.markers[0], pose=pose),)))
    assert float(read_csv(tmp_path / "out.csv")[0]["sd_x_m"]) == 0.0


def test_csv_quotes_a_hostile_name(tmp_path, make_result) -> None:
    path = tmp_path / "out.csv"
    name = 'a,"b"\n\udce9ö.png'
    write(path, replace(make_result(), source=name))
    assert read_csv(path)[0]["source"] == 'a,"b"\n\\udce9ö.png'


def test_tum_is_time_position_and_quaternion(tmp_path, make_result) -> None:
    path = tmp_path / "out.tum"
    write(path, make_result(1), make_result(2, ()), make_result(3))
    assert path.read_text().startswith("# T_camera_marker: timestamp tx ty tz qx qy qz qw\n")
    expected = [[t, 0.1, -0.2, 1.5, 0.0, 0.0, 0.5**0.5, 0.5**0.5] for t in (0.1, 0.1 * 3)]
    np.testing.assert_allclose(np.loadtxt(path), expected, rtol=1e-15, atol=1e-15)


def test_tum_of_the_camera_from_the_marker(tmp_path, make_result) -> None:
    path = tmp_path / "out.tum"
    write(path, make_result(1), inverse=True)
    # p_marker = R^T (p_camera - t), R a quarter turn about z: -t turned back is (0.2, 0.1, -1.5)
    expected = [0.1, 0.2, 0.1, -1.5, 0.0, 0.0, -(0.5**0.5), 0.5**0.5]
    np.testing.assert_allclose(np.loadtxt(path), expected, atol=1e-15)


def test_tum_of_the_chosen_marker(tmp_path, make_result) -> None:
    path = tmp_path / "out.tum"
    both = (("tag36h11", 7), ("tag36h11", 8))
    write(path, make_result(1, both), make_result(2, both[:1]), marker=both[1])
    assert np.loadtxt(path)[0] == 0.1


def test_tum_of_a_marker_seen_twice_takes_the_first(tmp_path, make_result) -> None:
    path = tmp_path / "out.tum"
    image = make_result(1, (("tag36h11", 7), ("tag36h11", 7)))
    farther = RigidTransform.from_translation([0.0, 0.0, 9.0])
    second = replace(image.markers[1].pose.best, T_camera_marker=farther)
    pose = replace(image.markers[1].pose, hypotheses=(second,))
    write(path, replace(image, markers=(image.markers[0], replace(image.markers[1], pose=pose))))
    np.testing.assert_allclose(np.loadtxt(path)[1:4], [0.1, -0.2, 1.5])


def test_tum_counts_images_without_a_time(tmp_path, make_result) -> None:
    path = tmp_path / "out.tum"
    write(path, *(replace(make_result(n), time_s=0.0, time_kind="none") for n in (0, 1, 2)))
    assert np.loadtxt(path)[:, 0].tolist() == [0.0, 1.0, 2.0]


def test_tum_refuses_to_mix_markers(tmp_path, make_result) -> None:
    both = (("tag36h11", 8), ("tag36h11", 7))
    with pytest.raises(InputError, match="choose one of tag36h11 7, tag36h11 8"):
        write(tmp_path / "out.tum", make_result(0, both))
    assert list(tmp_path.iterdir()) == []


def test_tum_refuses_a_marker_that_never_came(tmp_path, make_result) -> None:
    with pytest.raises(InputError, match="no pose of 4x4_50 1 in any image; seen: tag36h11 7"):
        write(tmp_path / "out.tum", make_result(), marker=("4x4_50", 1))
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", FINITE)
def test_a_failed_run_leaves_the_old_file_and_nothing_else(tmp_path, make_result, name) -> None:
    path = tmp_path / name
    path.write_text("old")
    with pytest.raises(OSError, match="camera"):
        write_until(path, make_result(), OSError("the camera went away"))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", FINITE)
def test_ctrl_c_keeps_what_was_recorded(tmp_path, make_result, name) -> None:
    path, whole = tmp_path / name, tmp_path / f"whole_{name}"
    with pytest.raises(KeyboardInterrupt):
        write_until(path, make_result(), KeyboardInterrupt())
    write(whole, make_result())
    assert path.read_bytes() == whole.read_bytes()


@pytest.mark.parametrize("name", FINITE)
def test_nothing_is_there_before_the_end(tmp_path, make_result, name) -> None:
    path = tmp_path / name
    with open_writer(path) as writer:
        writer.write(make_result())
        assert not path.exists()
    assert path.exists()


@pytest.mark.parametrize("name", FINITE)
def test_a_run_without_images_is_a_readable_file(tmp_path, name) -> None:
    write(tmp_path / name)
    assert (tmp_path / name).stat().st_size > 0
    if name == "out.parquet":
        assert list(read_results(tmp_path / name)) == []


@pytest.mark.parametrize("name", FINITE)
def test_refuses_a_folder_that_is_missing(tmp_path, name) -> None:
    with pytest.raises(InputError, match="cannot write"):
        write(tmp_path / "none" / name)


@pytest.mark.parametrize("name", ["out.xls", "out", ".csv"])
def test_an_unknown_suffix_lists_those_there_are(tmp_path, name) -> None:
    with pytest.raises(InputError, match=r"ending in \.jsonl, \.csv, \.parquet, \.tum, found"):
        open_writer(tmp_path / name)
    with pytest.raises(InputError, match=r"ending in \.jsonl, \.parquet, found"):
        read_results(tmp_path / name)


def test_a_suffix_may_be_in_capitals(tmp_path, make_result) -> None:
    write(tmp_path / "OUT.CSV", make_result())
    assert len(read_csv(tmp_path / "OUT.CSV")) == 1


@pytest.mark.parametrize("content", [b"", b"PAR1", b"text", b"PAR1" + bytes(100) + b"PAR1"])
def test_refuses_what_is_no_parquet(tmp_path, content) -> None:
    path = tmp_path / "bad.parquet"
    path.write_bytes(content)
    with pytest.raises(InputError, match="no readable Parquet"):
        list(read_results(path))


def test_refuses_a_foreign_parquet(tmp_path) -> None:
    import pyarrow as pa

    path = tmp_path / "foreign.parquet"
    pq.write_table(pa.table({"source": ["a"]}), path)
    with pytest.raises(InputError, match=r"foreign\.parquet: sequence: Field required"):
        list(read_results(path))


def test_names_the_missing_part(tmp_path, monkeypatch, make_result) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(MissingExtraError, match=r"writing Parquet .*tagmetry\[parquet\]"):
        write(tmp_path / "out.parquet", make_result())
    with pytest.raises(MissingExtraError, match="reading Parquet"):
        list(read_results(tmp_path / "out.parquet"))
    assert list(tmp_path.iterdir()) == []

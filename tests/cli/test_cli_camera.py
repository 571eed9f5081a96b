"""`tagmetry camera`: what files hold, and the same camera in other formats and windows."""

import json
from pathlib import Path

import numpy as np
import pytest
from cli_command import Scene

from tagmetry.camera import BrownLens, Camera, FisheyeLens, cropped, rotated, scaled, zoomed
from tagmetry.cli.main import run
from tagmetry.files import load_camera, save_camera

# The calibration that seed 003 prints in its tables 3 and 4.
SEED_003 = Camera(
    640,
    480,
    (698.5167477, 698.0543131),
    (322.7119836, 236.2582937),
    BrownLens(
        (
            -0.11785701583978955,
            1.5199508775591315,
            -0.016984594698011175,
            -0.0014976151455554812,
            -5.275252972815059,
        )
    ),
)
BROWN = Camera(
    1280,
    960,
    (901.5, 899.25),
    (651.125, 470.0625),
    BrownLens((-0.21, 0.043, 0.0011, -0.0007, 0.002)),
    covariance=np.diag([1.0, 1.1, 0.4, 0.5, 1e-4, 1e-4, 1e-8, 1e-8, 1e-5]),
    zoom=1.5,
    focus=30.0,
    name="ceiling",
    provenance="40 views of a board",
)
FISHEYE = Camera(800, 600, (300.0, 301.0), (399.0, 301.0), FisheyeLens((0.01, -0.002, 0.0, 0.0)))


def same(found: Camera, expected: Camera) -> None:
    assert found.size_px == expected.size_px
    assert found.lens.kind == expected.lens.kind
    np.testing.assert_allclose(found.focal_px, expected.focal_px, rtol=1e-14)
    np.testing.assert_allclose(found.center_px, expected.center_px, rtol=1e-14)
    np.testing.assert_allclose(found.lens.coefficients, expected.lens.coefficients, rtol=1e-14)


def saved(camera: Camera, folder: Path) -> str:
    path = folder / "camera.yaml"
    save_camera(camera, path)
    return str(path)


@pytest.mark.parametrize("camera", [BROWN, FISHEYE, SEED_003], ids=["brown", "fisheye", "003"])
@pytest.mark.parametrize(
    ("file_format", "name"),
    [
        ("ros", "a.yaml"),
        ("opencv", "a.yml"),
        ("opencv", "a.json"),
        ("kalibr", "a.yaml"),
        ("mrcal", "a.cameramodel"),
        ("photonvision", "a.json"),
        ("colmap", "a.txt"),
    ],
)
def test_every_format_leads_back(
    camera: Camera, file_format: str, name: str, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    if file_format == "kalibr" and len(camera.lens.coefficients) == 5:
        pytest.skip("Kalibr has no fifth coefficient")
    if file_format in ("mrcal", "photonvision") and camera.lens.kind == "fisheye":
        pytest.skip("they have no fisheye lens")
    first, other, back = saved(camera, tmp_path), tmp_path / name, tmp_path / "back.yaml"
    other = other.with_stem("other")
    assert run(["camera", "convert", first, str(other), "--format", file_format]) == 0
    size = f"{camera.width_px}x{camera.height_px}"
    assert capsys.readouterr().out == f"wrote {size} camera -> {other}\n"
    assert run(["camera", "convert", str(other), str(back)]) == 0
    found = load_camera(back)
    same(found, camera)
    assert (found.zoom, found.focus) == (camera.zoom, camera.focus)
    if camera.covariance is not None:
        np.testing.assert_allclose(found.covariance, camera.covariance, rtol=1e-12)


@pytest.mark.parametrize("camera", [BROWN, SEED_003], ids=["brown", "003"])
def test_kalibr_refuses_what_it_cannot_hold(
    camera: Camera, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    first, out = saved(camera, tmp_path), tmp_path / "kalibr.yaml"
    assert run(["camera", "convert", first, str(out), "--format", "kalibr"]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not out.exists()


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["--crop", "640x480+100+50"], cropped(BROWN, 100, 50, 640, 480)),
        (["--scale-to", "640x480"], scaled(BROWN, 640, 480)),
        (["--zoom", "2.5"], zoomed(BROWN, 2.5)),
        (["--rotate", "90"], rotated(BROWN, 1)),
        (["--rotate", "-90"], rotated(BROWN, 3)),
        (["--rotate", "180"], rotated(BROWN, 2)),
        (
            ["--rotate=270", "--zoom=2", "--scale-to=320x240", "--crop=640x480+3+4"],
            rotated(zoomed(scaled(cropped(BROWN, 3, 4, 640, 480), 320, 240), 2), 3),
        ),
    ],
    ids=["crop", "scale", "zoom", "right", "left", "round", "all"],
)
def test_converts_as_the_library_does(options: list[str], expected: Camera, tmp_path: Path) -> None:
    out = tmp_path / "out.yaml"
    assert run(["camera", "convert", saved(BROWN, tmp_path), str(out), *options]) == 0
    found = load_camera(out)
    same(found, expected)
    np.testing.assert_allclose(found.covariance, expected.covariance, rtol=1e-12, atol=1e-20)
    assert found.zoom == expected.zoom


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (["--format=yaml"], "unknown format 'yaml'; there are ros, opencv, kalibr, mrcal, photon"),
        (["--crop=640x480"], "expected pixels like 640x480+100+50, found '640x480'"),
        (["--crop=0x480+0+0"], "image size must be positive"),
        (["--crop=9999999x1+0+0"], "expected pixels like"),
        (["--scale-to=٣x٣"], "expected pixels like 640x480"),
        (["--zoom=0.5"], "a digital zoom is at least 1, got 0.5"),
        (["--zoom=nan"], "a digital zoom is at least 1, got nan"),
        (["--rotate=45"], "multiples of 90 degrees, got 45"),
        (["--name=other"], "there is no camera 'other'"),
    ],
)
def test_refuses(
    options: list[str], text: str, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    out = tmp_path / "out.yaml"
    assert run(["camera", "convert", saved(BROWN, tmp_path), str(out), *options]) == 2
    assert text in capsys.readouterr().err
    assert not out.exists()


def test_warns_of_the_fold_that_seed_003_prints(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    path = saved(SEED_003, tmp_path)
    assert run(["camera", "show", path]) == 0
    assert "WARNING: the distortion folds inside the image" in capsys.readouterr().out
    assert run(["camera", "show", path, "--json"]) == 0
    table = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert table["distortion_covers_image"] is False
    assert 0.5 < table["covered_share"] < 1


@pytest.mark.parametrize(
    ("camera", "text"),
    [
        (Camera(640, 480, (500.0, 500.0), (900.0, 240.0)), "the principal point lies outside"),
        (Camera(640, 480, (500.0, 700.0), (320.0, 240.0)), "fx and fy differ"),
    ],
)
def test_warns_of_odd_intrinsics(
    camera: Camera, text: str, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    assert run(["camera", "show", saved(camera, tmp_path)]) == 0
    assert f"WARNING: {text}" in capsys.readouterr().out


def test_shows_numbers_with_their_spread(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    path = saved(BROWN, tmp_path)
    assert run(["camera", "show", path]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[0] == "ceiling: 1280x960, brown lens"
    assert "fx         901.5 ± 1\n" in out
    assert "from: 40 views of a board" in out
    assert "zoom 1.5, focus 30.0" in out
    assert "WARNING" not in out
    assert run(["camera", "show", path, "--json"]) == 0
    table = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert table["focal_px"] == [901.5, 899.25]
    np.testing.assert_allclose(table["standard_deviations"], np.sqrt(np.diag(BROWN.covariance)))


def test_the_view_of_a_pinhole_is_the_closed_form(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    path = saved(Camera(640, 480, (320.0, 320.0), (319.5, 239.5)), tmp_path)
    assert run(["camera", "show", path, "--json"]) == 0
    view_deg = json.loads(capsys.readouterr().out)["view_deg"]
    np.testing.assert_allclose(view_deg, [90.0, 2 * np.degrees(np.arctan(0.75))])


def test_a_view_beyond_the_fold_is_null_in_json(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    folded = Camera(640, 480, (300.0, 300.0), (319.5, 239.5), BrownLens((-0.5, 0.0, 0.0, 0.0)))
    path = saved(folded, tmp_path)
    assert run(["camera", "show", path, "--json"]) == 0
    table = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert table["view_deg"][0] is None
    assert run(["camera", "show", path]) == 0
    assert "nan" not in capsys.readouterr().out


def test_the_showcase_reads_back(scene: Scene, capsys: pytest.CaptureFixture) -> None:
    assert run(["camera", "show", scene.camera]) == 0
    assert "k1         -0.18" in capsys.readouterr().out

"""Camera files as others write them, and a camera that uses every field."""

from pathlib import Path

import numpy as np

from tagmetry.camera import BrownLens, Camera
from tagmetry.files import load_camera

FULL = Camera(
    1920,
    1080,
    (1400.1, 1401.2),
    (959.3, 1e-7),
    BrownLens((-0.3, 0.1, 1e-5, -2e-4)),
    covariance=np.diag(np.arange(1.0, 9.0)),
    zoom=2.0,
    focus=35.5,
    name="ceiling: north",
    provenance='calibrated "by hand",\n2 views',
)

ROS = """\
image_width: 640
image_height: 480
camera_name: 00314159
camera_matrix:
  rows: 3
  cols: 3
  data: [739.08, 0, 321.5, 0, 740.12, 1e2, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [-0.36, 0.13, 4.6e-05, -1e-3, 0]
rectification_matrix:
  rows: 3
  cols: 3
  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]
"""

KALIBR = """\
cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05]
  distortion_model: radtan
  intrinsics: [458.654, 457.296, 367.215, 248.375]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 1.0, 0.0, 0.0]
  - [0.0, 0.0, 1.0, 0.0]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [0.01, -0.02, 0.003, -0.0004]
  distortion_model: equidistant
  intrinsics: [457.587, 456.134, 379.999, 255.238]
  resolution: [752, 481]
  rostopic: /cam1/image_raw
"""

OPENCV = """\
%YAML:1.0
---
image_width: 640
image_height: 480
fisheye_model: 0
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.0e+02, 0., 3.2e+02, 0., 5.0e+02, 2.4e+02, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 4
   cols: 1
   dt: d
   data: [ 1.0e-01, 0., 0., 0. ]
"""


def load_text(tmp_path: Path, text: str, name: str | None = None) -> Camera:
    path = tmp_path / "cam.yaml"
    path.write_text(text)
    return load_camera(path, name)


def assert_equal(found: Camera, expected: Camera) -> None:
    assert str(found.lens) == str(expected.lens)
    for field in ("size_px", "focal_px", "center_px", "zoom", "focus", "name", "provenance"):
        assert repr(getattr(found, field)) == repr(getattr(expected, field))
    if expected.covariance is None:
        assert found.covariance is None
    else:
        np.testing.assert_array_equal(found.covariance, expected.covariance)

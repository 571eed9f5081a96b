"""A scene as POV-Ray renders it, for pictures of another ray tracer.

POV-Ray looks along z with y up, so that a point (x, y, z) of the camera is its (x, -y, z). Its
pixel (i, j) of W x H looks along

    direction + ((i + 1/2) / W - 1/2) right + (1/2 - (j + 1/2) / H) up,

the middle of the pixel. With right = W / fx and up = H / fy this is our ((u - cx) / fx, (v - cy) /
fy, 1) if direction = ((W/2 - 1/2 - cx) / fx, (cy + 1/2 - H/2) / fy, 1). Rendered n times larger
over the same image plane, the mean of n x n of its pixels is the mean over ours.

All is matt and lit evenly, so that a tone is a number. Ink lies a ten-thousandth nearer along the
ray, which moves no projection. A camera without distortion stands at the origin.
"""

import shutil
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest

from tagmetry.camera import Camera
from tagmetry.geometry import Array, RigidTransform
from tagmetry.twin import Scene
from tagmetry.twin.scenes import Dot, Print, Sheet

_FINER = 16
_NEARER = 1 - 1e-4
_NOW = np.zeros(1)


def traced(scene: Scene, camera: Camera, folder: Path) -> Array:
    """Return POV-Ray's picture, shape (height, width), radiance; skips where there is none."""
    program = shutil.which("povray")
    if program is None:
        pytest.skip("povray is not installed")
    source, target = folder / "scene.pov", folder / "scene.png"
    source.write_text("\n".join([_head(scene, camera), *_shapes(scene)]))
    width, height = (_FINER * side for side in camera.size_px)
    command = [program, f"+I{source}", f"+O{target}", f"+W{width}", f"+H{height}", "-D", "-A"]
    command += ["+FN16", "Grayscale_Output=on", "File_Gamma=1.0", "Work_Threads=2"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    large = cv2.imread(str(target), cv2.IMREAD_UNCHANGED).astype(np.float64) / 65535
    return large.reshape(camera.height_px, _FINER, camera.width_px, _FINER).mean(axis=(1, 3))


def _head(scene: Scene, camera: Camera) -> str:
    (fx, fy), (cx, cy) = camera.focal_px, camera.center_px
    width, height = camera.size_px
    x, y = (width / 2 - 0.5 - cx) / fx, (cy + 0.5 - height / 2) / fy
    return (
        "#version 3.7;\n"
        "global_settings { assumed_gamma 1 ambient_light rgb 1 }\n"
        f"background {{ rgb {scene.background} }}\n"
        f"camera {{ perspective location <0,0,0> direction <{x!r},{y!r},1> "
        f"right <{width / fx!r},0,0> up <0,{height / fy!r},0> }}"
    )


def _shapes(scene: Scene) -> list[str]:
    shapes = []
    for thing in scene.things:
        for sheet in thing.sheets:
            T_camera_sheet = thing.path.at(_NOW)[0] * sheet.T_thing_sheet
            corners = T_camera_sheet.apply(sheet.corners_m)
            shapes.append(_polygon(corners, sheet.paper))
            for printed in sheet.prints:
                shapes += _inked(printed, sheet, T_camera_sheet)
    return shapes


def _inked(printed: Print | Dot, sheet: Sheet, T_camera_sheet: RigidTransform) -> list[str]:
    if isinstance(printed, Dot):
        return [_disc(printed, sheet.ink, T_camera_sheet)]
    rows, columns = printed.ink.shape
    shapes = []
    for row, column in np.argwhere(printed.ink == 1):
        left = printed.center_m[0] + (column - columns / 2) * printed.cell_m
        top = printed.center_m[1] + (rows / 2 - row) * printed.cell_m
        right, low = left + printed.cell_m, top - printed.cell_m
        corners = np.array([[left, top, 0], [right, top, 0], [right, low, 0], [left, low, 0]])
        shapes.append(_polygon(_NEARER * T_camera_sheet.apply(corners), sheet.ink))
    return shapes


def _disc(dot: Dot, tone: float, T_camera_sheet: RigidTransform) -> str:
    middle = _NEARER * T_camera_sheet.apply([*dot.center_m, 0.0])
    normal = T_camera_sheet.rotation.as_matrix()[:, 2]
    radius = _NEARER * dot.radius_m
    return f"disc {{ {_vector(middle)}, {_vector(normal)}, {radius!r} {_tone(tone)} }}"


def _polygon(corners: Array, tone: float) -> str:
    points = ", ".join(_vector(p) for p in [*corners, corners[0]])
    return f"polygon {{ 5, {points} {_tone(tone)} }}"


def _vector(p: Array) -> str:
    return f"<{float(p[0])!r}, {-float(p[1])!r}, {float(p[2])!r}>"


def _tone(tone: float) -> str:
    return f"pigment {{ rgb {tone} }} finish {{ ambient 1 diffuse 0 }}"

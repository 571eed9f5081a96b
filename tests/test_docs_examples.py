"""Every example of the documentation runs as it stands, in a folder that has what it reads."""

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pytest

import tagmetry
from tagmetry.camera import Camera
from tagmetry.files import save_camera
from tagmetry.geometry import RigidTransform
from tagmetry.geometry.arrays import GreyPixels
from tagmetry.geometry.transforms import Rotation
from tagmetry.markers import Chessboard, GridBoard, MountedMarker
from tagmetry.twin import Scene, Shot, render
from tagmetry.twin import photograph as photographed
from tagmetry.twin.scenes import Still, board_thing

SOURCE = Path(tagmetry.__file__).parents[1]
EXAMPLES = Path(__file__).parents[1] / "docs" / "examples"
SCENES = EXAMPLES.parent / "scenes"
MAPS = EXAMPLES.parent / "maps"
ARENAS = EXAMPLES.parent / "arenas"
NAMES = sorted(path.name for path in EXAMPLES.iterdir() if path.is_file())
CAMERA = Camera(1280, 720, (1000.0, 1000.0), (639.5, 359.5), name="example")

WALL = tuple(
    MountedMarker("tag36h11", marker_id, 0.12, RigidTransform.from_translation([x_m, 0.0, 0.0]))
    for marker_id, x_m in ((7, -0.2), (8, 0.2))
)
BOARD = GridBoard(3, 2, 0.08, 0.02, "tag36h11", first_id=20).markers()
FLOOR = tuple(
    MountedMarker("tag36h11", marker_id, size_m, RigidTransform.from_translation([x_m, y_m, 0]))
    for marker_id, size_m, x_m, y_m in (
        (0, 0.14, 0.0, 0.0),
        (1, 0.05, 0.2, 0.1),
        (2, 0.05, -0.2, 0),
    )
)
HELD = (  # where a chessboard is held before a webcam: metres, degrees about x and y
    ((-0.06, -0.04, 0.50), (155, 10)),
    ((0.06, -0.04, 0.45), (200, -25)),
    ((-0.07, 0.04, 0.48), (180, 30)),
    ((0.07, 0.05, 0.52), (210, 15)),
    ((0.00, 0.00, 0.36), (175, -8)),
    ((0.02, 0.03, 0.60), (150, -30)),
    ((-0.03, -0.02, 0.42), (190, 35)),
    ((0.00, 0.02, 0.55), (145, 20)),
)
WRITTEN = {
    "arena.sh": ("lab.world.yaml", "states.jsonl"),
    "arena_stability.sh": ("stability.png",),
    "arena_twin.sh": ("ways.png",),
    "bank.py": ("bank.yaml",),
    "calibrate.py": ("webcam.yaml",),
    "calibrate.sh": ("webcam.yaml", "webcam.html", "tables/camera.csv"),
    "camera_files.py": ("half.yaml", "middle.yaml"),
    "camera_files.sh": ("half.yaml",),
    "compare.sh": ("errors.png",),
    "detect.sh": ("overlay.png", "markers.jsonl"),
    "detect_drive.sh": ("drive.mp4", "drive.jsonl"),
    "detect_only.sh": ("overlay.png", "markers.jsonl"),
    "detect_video.sh": ("robots.parquet",),
    "lens_demo.sh": ("trace.jsonl",),
    "locate.sh": ("where.jsonl", "where.png"),
    "recording.py": ("run.mcap", "tables/detections.csv"),
    "plan.sh": ("volume.png",),
    "print_micro.sh": ("micro.pdf", "micro.svg"),
    "print_robots.sh": ("robots.pdf", "floor.pdf"),
    "print_sheet.sh": ("sheet.pdf",),
    "print_walls.sh": ("wall7.pdf", "board.pdf"),
    "rough_camera.py": ("rough.yaml",),
    "track.sh": ("tracked.jsonl",),
    "twin_render.sh": ("desk/truth.jsonl", "desk.jsonl"),
}
SAID = {
    "arena.sh": "camera at x",
    "arena_state.py": "robot 1 knows of [2]",
    "arena_stability.sh": "of air left",
    "arena_twin.sh": "m driven, places within",
    "bank.py": "at focus 53: fx 1005.",
    "calibrate.py": "8 views leave projections uncertain",
    "calibrate.sh": "8 views leave projections uncertain",
    "compare.sh": "4 poses over 3.000 m",
    "board_pose.py": "6 markers, board at",
    "detect.py": "tag36h11 7 ",
    "computers.py": "commanded: 0.2 m/s",
    "doctor.sh": "tag36h11",
    "floor_positions.py": "robot 1: +0.20",
    "lens_demo.sh": "stated deviations",
    "lens_loop.py": "mm ±",
    "link.py": "later: 0.0 m/s",
    "live_client.py": "robot 0 is on a walk at -0.",
    "locate.py": "by 2 markers",
    "locate.sh": "2 markers",
    "plan.py": "found up to",
    "plan.sh": "the smallest marker that will do",
    "pose.py": "tag36h11 8: +0.2000 ",
    "read_results.py": "photo.png 7 ",
    "recording.py": "photo.png [7, 8]",
    "recording_moment.py": '{"volts":7.',
    "robot_position.py": "camera at [ 4.15",
    "track.py": "0.20 s: 2 at",
    "twin_arena.py": "true distance 200",
    "twin_render.sh": "wrote 3 pictures",
    "twin_scene.py": "farthest corner: 0.0",
    "wall_body.py": "from 2 markers",
}
AFTER = {"read_results.py": "detect.sh", "floor_positions.py": "detect_video.sh"}
NEEDS = {
    "arena_stability.sh": ["matplotlib"],
    "arena_twin.sh": ["matplotlib", "mujoco"],
    "arena_twin_processes.sh": ["mujoco"],
    "twin_arena.py": ["mujoco"],
    "calibrate.sh": ["matplotlib"],
    "compare.sh": ["matplotlib"],
    "computers.py": ["zenoh"],
    "detect_drive.sh": ["av"],
    "detect_video.sh": ["av", "pyarrow"],
    "floor_positions.py": ["av", "pyarrow"],
    "live_client.py": ["fastapi", "mujoco", "uvicorn", "websockets"],
    "locate.sh": ["matplotlib"],
    "plan.sh": ["matplotlib"],
    "recording.py": ["mcap"],
    "recording_moment.py": ["mcap"],
    "track.py": ["av"],
    "track.sh": ["av"],
    **{name: ["reportlab"] for name in NAMES if name.startswith("print_")},
}


def photograph(markers: Sequence[MountedMarker], tilt_deg: float, depth_m: float) -> GreyPixels:
    """Render markers on a wall that leans back by an angle, seen by `CAMERA`."""
    R_camera_wall = Rotation.from_euler("x", 180 + tilt_deg, degrees=True)
    T_camera_wall = RigidTransform.from_components([0.0, 0.0, depth_m], R_camera_wall)
    return render(markers, T_camera_wall, CAMERA, np.random.default_rng(1))


def write_boards(folder: Path) -> None:
    """Write pictures of a chessboard that is held before a webcam."""
    folder.mkdir()
    board = Chessboard(7, 5, 0.030)
    webcam = Camera(640, 480, (600.0, 600.0), (322.0, 238.0))
    shot = Shot(webcam, Still(RigidTransform.identity()))
    for number, (place_m, turn_deg) in enumerate(HELD):
        turn = Rotation.from_euler("xy", turn_deg, degrees=True)
        path = Still(RigidTransform.from_components(place_m, turn))
        scene = Scene((board_thing(board, path),))
        pixels = photographed(scene, shot, np.random.default_rng(number))
        cv2.imwrite(str(folder / f"{number}.png"), pixels)


def write_ways(folder: Path) -> None:
    """Write a robot's way as it is and as it was measured."""
    for name, off_m in (("true.tum", 0.0), ("where.tum", 0.01)):
        lines = [f"{second} {second} {off_m} 0.3 0 0 0 1" for second in range(4)]
        (folder / name).write_text("\n".join(lines), "utf-8")


def write_arena(folder: Path) -> None:
    """Write an arena's file with its camera, a picture of its floor, and two robots that drive."""
    shutil.copy(ARENAS / "lab.yaml", folder)
    ceiling = Camera(960, 540, (640.0, 640.0), (478.0, 272.0))
    save_camera(ceiling, folder / "ceiling.yaml")
    down = Rotation.from_euler("x", 180, degrees=True)
    T_camera_world = RigidTransform.from_components([0.0, 0.0, 1.5], down)
    floor = [
        MountedMarker("tag36h11", 100 + n, 0.12, RigidTransform.from_translation([x, y, 0.0]))
        for n, (x, y) in enumerate(((0, 0), (0.9, 0), (0.85, 0.45), (-0.85, -0.45)))
    ]
    (folder / "drive").mkdir()
    for k in range(4):
        robots = [
            MountedMarker(
                "tag36h11", n, 0.08, RigidTransform.from_translation([x, 0.02 * k, 0.093])
            )
            for n, x in ((1, -0.3), (2, -0.6))
        ]
        shown = [*floor, *robots] if k else floor
        pixels = render(shown, T_camera_world, ceiling, np.random.default_rng(k))
        cv2.imwrite(
            str(folder / ("drive" if k else "") / (f"{k}.png" if k else "floor.png")), pixels
        )


def write_video(path: Path, image: GreyPixels) -> None:
    av = pytest.importorskip("av", reason="videos need the part video")
    with av.open(str(path), "w") as container:
        stream = container.add_stream("mpeg4", rate=10)
        stream.width, stream.height, stream.pix_fmt = CAMERA.width_px, CAMERA.height_px, "yuv420p"
        stream.bit_rate = 20_000_000
        for _ in range(3):
            frame = av.VideoFrame.from_ndarray(np.repeat(image[..., None], 3, axis=2), "bgr24")
            container.mux(stream.encode(frame))
        container.mux(stream.encode())


@pytest.fixture(scope="module")
def shelf(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The files that examples read, and the command `tagmetry`, made once."""
    folder = tmp_path_factory.mktemp("shelf")
    cv2.imwrite(str(folder / "photo.png"), photograph(WALL, tilt_deg=20, depth_m=0.9))
    cv2.imwrite(str(folder / "board.png"), photograph(BOARD, tilt_deg=-25, depth_m=0.5))
    save_camera(CAMERA, folder / "camera.yaml")
    write_boards(folder / "boards")
    command = folder / "bin" / "tagmetry"
    command.parent.mkdir()
    command.write_text(
        f"#!{sys.executable} -Werror\nfrom tagmetry.cli.main import main\nmain()\n", "utf-8"
    )
    command.chmod(0o755)
    return folder


def run(name: str, folder: Path, shelf: Path) -> str:
    script = EXAMPLES / name
    path = os.pathsep.join([str(shelf / "bin"), os.environ["PATH"]])
    command = ["bash", "-e", str(script)]
    if script.suffix == ".py":
        command = [sys.executable, "-W", "error", str(script)]
    ran = subprocess.run(
        command,
        cwd=folder,
        check=False,
        env={**os.environ, "PATH": path, "PYTHONPATH": str(SOURCE)},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,  # kernels are compiled by whoever comes first
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    return ran.stdout + ran.stderr


@pytest.mark.parametrize("name", NAMES)
def test_example_runs(name: str, shelf: Path, tmp_path: Path) -> None:
    if name.endswith(".sh") and shutil.which("bash") is None:
        pytest.skip("shell examples need bash")
    for package in NEEDS.get(name, []):
        pytest.importorskip(package, reason=f"{name} needs {package}")
    for file in ("photo.png", "board.png", "camera.yaml"):
        shutil.copy(shelf / file, tmp_path)
    shutil.copy(SCENES / "desk.yaml", tmp_path)
    shutil.copy(MAPS / "hall.yaml", tmp_path)
    shutil.copytree(shelf / "boards", tmp_path / "boards")
    shutil.copy(EXAMPLES / "keep_away.py", tmp_path)
    shutil.copy(EXAMPLES / "spread.py", tmp_path)
    if name.startswith("arena"):
        write_arena(tmp_path)
    write_ways(tmp_path)
    if "av" in NEEDS.get(name, []):
        write_video(tmp_path / "video.mp4", photograph(FLOOR, tilt_deg=10, depth_m=1.2))
    if name in AFTER:
        run(AFTER[name], tmp_path, shelf)
    said = run(name, tmp_path, shelf)
    assert SAID.get(name, "") in said
    for written in WRITTEN.get(name, ()):
        assert (tmp_path / written).stat().st_size > 0, written

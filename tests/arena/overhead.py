"""A camera over a floor, robots on it, and their markers as a detector would give them."""

import numpy as np

from tagmetry.arena import Mount, OverheadView, Robot
from tagmetry.camera import BrownLens, Camera
from tagmetry.detect import Detection
from tagmetry.geometry import Array, RigidTransform, perturb_pose
from tagmetry.geometry.transforms import Rotation

CAMERA = Camera(
    1920, 1080, (1273.0, 1270.0), (952.4, 545.1), BrownLens((-0.2, 0.05, 0.0004, -0.0007))
)
LOOKING_DOWN = Rotation.from_euler("xyz", [183, 4, 20], degrees=True)
VIEW = OverheadView(
    CAMERA, RigidTransform.from_components([0.1, -0.05, 2.5], LOOKING_DOWN), np.zeros((6, 6))
)
NOISE_PX = 0.05


def robot(number: int, height_m: float = 0.1, **mount: float) -> Robot:
    return Robot(
        number, f"robot {number}", 0.16, "tag36h11", number, 0.08, Mount(height_m, **mount)
    )


def marker_pose(place: Array, mount: Mount) -> RigidTransform:
    """Return T_world_marker of a robot at (x, y, heading), written out in rotations."""
    T_world_robot = RigidTransform.from_components(
        [place[0], place[1], 0.0], Rotation.from_euler("z", place[2])
    )
    T_robot_marker = RigidTransform.from_components(
        [mount.forward_m, mount.left_m, mount.height_m],
        Rotation.from_euler("z", mount.turn_rad - np.pi / 2),
    )
    return T_world_robot * T_robot_marker


def detected(
    family: str,
    marker_id: int,
    size_m: float,
    T_world_marker: RigidTransform,
    view: OverheadView = VIEW,
    rng: np.random.Generator | None = None,
    noise_px: float = NOISE_PX,
) -> Detection:
    half = size_m / 2
    corners = np.array([[-half, half, 0], [half, half, 0], [half, -half, 0], [-half, -half, 0]])
    p_camera = view.T_world_camera.inv().apply(T_world_marker.apply(corners))
    pixels = view.camera.project(p_camera)
    if rng is not None:
        pixels = pixels + noise_px * rng.standard_normal((4, 2))
    return Detection(family, marker_id, pixels, noise_px**2 * np.eye(8), 0, 1.0)


def seen(
    one: Robot,
    place: Array,
    view: OverheadView = VIEW,
    rng: np.random.Generator | None = None,
    noise_px: float = NOISE_PX,
) -> Detection:
    """Return a robot's marker as it is seen at (x, y, heading)."""
    T_world_marker = marker_pose(place, one.mount)
    return detected(
        one.family, one.marker_id, one.marker_size_m, T_world_marker, view, rng, noise_px
    )


def moved(view: OverheadView, change: Array) -> OverheadView:
    """Return the camera after its pose was changed by a 6-vector."""
    return OverheadView(view.camera, perturb_pose(view.T_world_camera, change), view.covariance)

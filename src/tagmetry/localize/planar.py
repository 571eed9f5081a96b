"""A robot on a level floor: seed 004's equations derived afresh, and what is wrong in the printed.

The camera is level, at any height, and a marker stands upright. The camera's x is its right and z
its forward; the marker's x is its right as one looks at it and z comes out of its face. Then

    R_camera_marker = [ cos(theta)  0  -sin(theta) ]      marker x (its right, as seen)
                      [     0      -1       0      ]      marker y (up)
                      [-sin(theta)  0  -cos(theta) ]      marker z (out of its face)

theta is 0 where the camera looks straight at the marker, and grows as the robot turns left. So

    theta = atan2(-R[2, 0], R[0, 0])                                              (equation 1)

which in a quaternion's elements is atan2(2 (W Y - X Z), W^2 + X^2 - Y^2 - Z^2); the paper's, with
X Y - W Z, is the same for its library's axes. With (x, z) the marker in the camera's frame, and
`p_camera = 0` put into p_marker = R^T (p_camera - t), the robot in the marker's frame is

    x_m = -x cos(theta) + z sin(theta)
    z_m =  z cos(theta) + x sin(theta)                                            (equation 2)

that is, up to the direction of its first axis, the paper's x_w = x cos - z sin beside
y_w = z cos + x sin. It prints z cos - x sin. With that sign the map of (x, z) has determinant
cos(2 theta), so it is no rotation: at theta = 45 degrees all robots would stand on one line.

In the world the marker stands at (x_z, y_z) and its outward normal points to theta_z:

    x_w = x_z - x_m sin(theta_z) + z_m cos(theta_z)
    y_w = y_z + x_m cos(theta_z) + z_m sin(theta_z)                               (equation 3)
    theta_w = theta_z + pi + theta

theta_w is the camera's heading, from the world's x to its y.
"""

from dataclasses import dataclass

import numpy as np

from tagmetry.errors import InputError
from tagmetry.geometry import RigidTransform, UncertainTransform, wrap_angle_rad
from tagmetry.geometry.arrays import Array
from tagmetry.localize.result import CameraHypothesis

_UPRIGHT = np.cos(np.deg2rad(1))


@dataclass(frozen=True)
class PlanarPose:
    """A place on the floor and a heading.

    Attributes:
        x_m: In the world.
        y_m: In the world.
        heading_rad: From the world's x axis to its y axis, in (-pi, pi].
        covariance: Of (x, y, heading), shape (3, 3), m and rad; zero where it was not asked for.
    """

    x_m: float
    y_m: float
    heading_rad: float
    covariance: Array


def turn_to_marker_rad(T_camera_marker: RigidTransform) -> float:
    """Return theta, by how much the camera is turned left of looking straight at the marker.

    Reference: seed 004, equation 1.
    """
    R = T_camera_marker.rotation.as_matrix()
    return float(np.arctan2(-R[2, 0], R[0, 0]))


def beside_marker_m(T_camera_marker: RigidTransform) -> tuple[float, float]:
    """Return where the camera is beside the marker: to the marker's right, and before its face.

    Reference: seed 004, equation 2, with the sign of its second line put right.
    """
    x_m, _, z_m = T_camera_marker.translation
    theta = turn_to_marker_rad(T_camera_marker)
    right_m = -x_m * np.cos(theta) + z_m * np.sin(theta)
    before_m = z_m * np.cos(theta) + x_m * np.sin(theta)
    return float(right_m), float(before_m)


def camera_on_floor(T_camera_marker: RigidTransform, T_world_marker: RigidTransform) -> PlanarPose:
    """Return the camera's place and heading by one upright marker.

    Reference: seed 004, equation 3.

    Raises:
        InputError: The marker does not stand upright in the world.
    """
    R_world_marker = T_world_marker.rotation.as_matrix()
    if R_world_marker[2, 1] < _UPRIGHT:
        raise InputError("seed 004's equations are for upright markers: y up, within one degree")
    marker_x_m, marker_y_m, _ = T_world_marker.translation
    theta_z = np.arctan2(R_world_marker[1, 2], R_world_marker[0, 2])
    right_m, before_m = beside_marker_m(T_camera_marker)
    x_m = marker_x_m - right_m * np.sin(theta_z) + before_m * np.cos(theta_z)
    y_m = marker_y_m + right_m * np.cos(theta_z) + before_m * np.sin(theta_z)
    heading = wrap_angle_rad(theta_z + np.pi + turn_to_marker_rad(T_camera_marker))
    return PlanarPose(float(x_m), float(y_m), float(heading), np.zeros((3, 3)))


def robot_on_floor(camera: CameraHypothesis, T_robot_camera: RigidTransform) -> PlanarPose:
    """Return place and heading of a robot from its camera's pose.

    Args:
        camera: The camera in the world, best with `PlanarRobot.knowledge`.
        T_robot_camera: The camera on the robot, whose x is forward, y left, z up.

    Returns:
        With the covariance that the camera's has for x, y and heading; a robot's tilt is not told.
    """
    robot = camera.uncertain @ UncertainTransform.exact(T_robot_camera.inv())
    R = robot.T_a_b.rotation.as_matrix()
    x_m, y_m, _ = robot.T_a_b.translation
    rows = np.ix_([0, 1, 5], [0, 1, 5])
    heading = float(np.arctan2(R[1, 0], R[0, 0]))
    return PlanarPose(float(x_m), float(y_m), heading, robot.covariance[rows])

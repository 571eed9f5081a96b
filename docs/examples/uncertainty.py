import numpy as np

from tagmetry.geometry import RigidTransform, UncertainTransform

# A marker 2 m ahead of the camera, and a tool tip 0.3 m from the marker that is known exactly.
angle_rad, across_m, depth_m = np.radians(0.1), 0.0001, 0.002
covariance = np.diag([across_m, across_m, depth_m, angle_rad, angle_rad, angle_rad]) ** 2
T_camera_marker = UncertainTransform(RigidTransform.from_translation([0, 0, 2.0]), covariance)

p_camera, tip_covariance = T_camera_marker.apply(np.array([0.3, 0.0, 0.0]))
print("tip at", p_camera, "m, ±", 1000 * np.sqrt(np.diag(tip_covariance)), "mm")

T_marker_camera = T_camera_marker.inverse()
camera_deviation_mm = 1000 * np.sqrt(np.diag(T_marker_camera.covariance)[:3])
print("camera seen from the marker: ±", camera_deviation_mm, "mm")

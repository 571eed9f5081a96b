import tagmetry
from tagmetry.geometry import RigidTransform, UncertainTransform
from tagmetry.geometry.transforms import Rotation

# Marker 7 hangs 1.2 m high on the wall x = 5 m and faces -x: its x is the world's -y, its y is up.
R_world_marker = Rotation.from_matrix([[0, 0, -1], [-1, 0, 0], [0, 1, 0]])
T_world_marker = RigidTransform.from_components([5.0, 0.0, 1.2], R_world_marker)

camera = tagmetry.load_camera("camera.yaml")
detector = tagmetry.Detector(families=["tag36h11"])

with tagmetry.open_source("photo.png") as source:
    for image in source:
        for seen in detector.detect(image.pixels, camera):
            if seen.id != 7:
                continue
            T_camera_marker = tagmetry.estimate_pose(seen, camera, size_m=0.12).best.uncertain
            place = UncertainTransform.exact(T_world_marker) @ T_camera_marker.inverse()
            print("camera at", place.T_a_b.translation.round(3), "m")
            print("        ±", (place.covariance.diagonal()[:3] ** 0.5).round(4), "m")

import tagmetry
from tagmetry.geometry import RigidTransform
from tagmetry.markers import MarkerBody, MountedMarker

wall = MarkerBody(
    "wall",
    (
        MountedMarker("tag36h11", 7, 0.12, RigidTransform.from_translation([-0.2, 0.0, 0.0])),
        MountedMarker("tag36h11", 8, 0.12, RigidTransform.from_translation([0.2, 0.0, 0.0])),
    ),
)
camera = tagmetry.load_camera("camera.yaml")
detector = tagmetry.Detector(families=["tag36h11"])

with tagmetry.open_source("photo.png") as source:
    for image in source:
        pose = tagmetry.estimate_body_pose(detector.detect(image.pixels, camera), wall, camera)
        position_m = pose.best.T_camera_marker.translation
        print("wall at", position_m.round(3), "m, from", len(pose.used), "markers")

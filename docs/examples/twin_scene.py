import numpy as np

import tagmetry
from tagmetry.camera import BrownLens, Camera
from tagmetry.geometry import RigidTransform
from tagmetry.markers import MountedMarker
from tagmetry.twin import Optics, Scene, Shot, photograph
from tagmetry.twin.scenes import Still, looking, marker_thing
from tagmetry.twin.truth import image_truth

marker = MountedMarker("tag36h11", 7, 0.1, RigidTransform.identity())
scene = Scene((marker_thing([marker]),))
camera = Camera(640, 480, (600.0, 600.0), (319.5, 239.5), BrownLens((-0.2, 0.05, 0.0, 0.0)))
place = looking(np.array([0.2, -0.3, 0.6]), np.array([0.0, 0.0, 0.0]))
shot = Shot(camera, Still(place), optics=Optics(blur_px=0.7))

pixels = photograph(scene, shot, np.random.default_rng(0))
(truth,) = image_truth(scene, shot).markers
(found,) = tagmetry.Detector().detect(pixels, camera)
print("farthest corner:", np.abs(found.corners_px - truth.corners_px).max().round(3), "px")

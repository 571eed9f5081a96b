import tagmetry

camera = tagmetry.load_camera("camera.yaml")
detector = tagmetry.Detector(families=["tag36h11"])

with tagmetry.open_source("photo.png") as source:
    for image in source:
        for detection in detector.detect(image.pixels):
            pose = tagmetry.estimate_pose(detection, camera, size_m=0.12)
            position_m = pose.best.T_camera_marker.translation
            deviation_m = pose.covariance.diagonal()[:3] ** 0.5
            print(f"{detection.family} {detection.id}: {position_m} m, ± {deviation_m} m")
            print(f"  the mirrored pose is the true one with probability {pose.ambiguity:.2g}")

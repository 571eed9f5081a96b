import tagmetry

camera = tagmetry.load_camera("camera.yaml")
detector = tagmetry.Detector(families=["tag36h11"])

with tagmetry.open_source("photo.png") as source:
    for image in source:
        for detection in detector.detect(image.pixels, camera):
            pose = tagmetry.estimate_pose(detection, camera, size_m=0.12)
            x_m, y_m, z_m = pose.best.T_camera_marker.translation
            deviation_mm = 1000 * pose.covariance.diagonal()[:3] ** 0.5
            print(f"{detection.family} {detection.id}: {x_m:+.4f} {y_m:+.4f} {z_m:+.4f} m")
            print("  ±", deviation_mm.round(3), "mm; flipped:", pose.ambiguity)
